//! `index.html`: the whole run as one page that needs nothing else.

use super::html_parts::{ledger, matrix, misprinted, overview, stability};
use super::row::{Row, counts, counts_line, failing};
use super::{Drawn, RunSummary, Shown};
use crate::verdict::{Judged, Verdict};
use minijinja::{Environment, Value, context};

/// The page; SVG texts go in as they are, everything else is escaped.
pub fn index_html(run: &RunSummary) -> String {
    let mut environment = Environment::new();
    // The name's ending turns escaping on.
    environment.add_template("page.html", include_str!("page.html")).expect("the template is well-formed");
    environment
        .add_template("across.html", include_str!("across.html"))
        .expect("the template is well-formed");
    let studies: Vec<Value> = run
        .studies
        .iter()
        .map(|study| {
            let parts = study.text.split("\n\n").filter(|text| !text.trim().is_empty());
            let paragraphs: Vec<Value> = parts.map(Value::from).collect();
            context! {
                id => &study.id,
                title => &study.title,
                paragraphs,
                source => &study.source,
                counts => counts_line(&study.judged),
                figures => study.figures.iter().map(figure).collect::<Vec<Value>>(),
                rows => study.judged.iter().map(row).collect::<Vec<Value>>(),
            }
        })
        .collect();
    let failed: Vec<Value> = run.judged().filter(|one| failing(one.verdict)).map(row).collect();
    let manifest: Vec<Value> = run.manifest.iter().map(|(key, value)| context! { key, value }).collect();
    let page = context! {
        title => &run.title,
        command => &run.command,
        manifest,
        answer => answer(run),
        counts => tiles(run.judged()),
        failed,
        studies,
        overview => overview(run),
        stability => stability(run),
        ledger => ledger(run),
        misprints => misprinted(run),
        matrix => matrix(run),
        tables => run.tables.iter().map(shown).collect::<Vec<Value>>(),
        style => Value::from_safe_string(include_str!("page.css").into()),
        script => Value::from_safe_string(include_str!("page.js").into()),
    };
    let template = environment.get_template("page.html").expect("added above");
    template.render(page).expect("the template asks only for what is given")
}

fn shown(table: &Shown) -> Value {
    let number = |text: &String| context! { text, number => text.parse::<f64>().is_ok() };
    let rows: Vec<Vec<Value>> = table.rows.iter().map(|row| row.iter().map(number).collect()).collect();
    context! {
        id => &table.id,
        title => &table.title,
        caption => &table.caption,
        columns => &table.columns,
        rows,
    }
}

fn figure(drawn: &Drawn) -> Value {
    context! { title => &drawn.title, caption => &drawn.caption, svg => &drawn.svg }
}

fn row(judged: &Judged) -> Value {
    let row = Row::new(judged);
    context! {
        verdict => row.verdict,
        claim => row.claim,
        anchor => row.anchor,
        quantity => row.quantity,
        unit => row.unit,
        computed => row.computed,
        reference => row.reference,
        error => row.error,
        error_kind => row.error_kind,
        bound => row.bound,
        basis => row.basis,
        because => row.because,
        order => row.order,
        note => row.note,
        source => row.source,
    }
}

/// The first sentence a reader wants.
fn answer(run: &RunSummary) -> String {
    let count = |wanted: &[Verdict]| run.judged().filter(|one| wanted.contains(&one.verdict)).count();
    let total = run.judged().count();
    let held = count(&[Verdict::Pass, Verdict::Xfail]);
    let broken = count(&[Verdict::Fail, Verdict::Xpass, Verdict::Error]);
    match (total, broken) {
        (0, _) => "Nothing was judged.".to_owned(),
        (_, 0) if held == total => format!("All {total} claims came out as expected."),
        (_, 0) => {
            format!("{held} of {total} claims came out as expected, none failed; the rest was not judged.")
        }
        _ => format!("{broken} of {total} claims failed."),
    }
}

fn tiles<'a>(judged: impl Iterator<Item = &'a Judged>) -> Vec<Value> {
    let meaning = |verdict| match verdict {
        Verdict::Pass => "bound holds",
        Verdict::Fail => "bound broken",
        Verdict::Xfail => "broken as expected",
        Verdict::Xpass => "holds, expected not to",
        Verdict::Inconclusive => "could not be judged",
        Verdict::Error => "computation failed",
        Verdict::Skipped => "did not run",
    };
    let tile = |(verdict, count): (Verdict, usize)| {
        context! { word => verdict.word(), count, meaning => meaning(verdict) }
    };
    counts(judged).into_iter().filter(|(verdict, n)| *n > 0 || *verdict == Verdict::Pass).map(tile).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn text_is_escaped_and_figures_are_not() {
        let page = index_html(&sample::run());
        assert!(page.contains("twenty times &lt;b&gt;too large"));
        assert!(page.contains("A &lt; B"));
        assert!(page.contains("<svg xmlns="));
        assert!(page.contains("<title id=\"figure-curves-title\">Curves &lt;of&gt; ω</title>"));
    }

    #[test]
    fn the_page_needs_nothing_else() {
        let page = index_html(&sample::run());
        for outside in ["<script src", "<link", "@import", "url(", "src=", "href=\"http", "fetch(", "import("]
        {
            assert!(!page.contains(outside), "{outside}");
        }
    }

    #[test]
    fn all_that_is_said_stands_there_before_any_script_runs() {
        let page = index_html(&sample::run());
        let (text, script) = page.split_once("<script>").unwrap();
        let text = text.replace("&#x2f;", "/");
        assert!(script.trim_end().ends_with("</html>") && !text.contains("hidden"));
        for judged in sample::run().judged() {
            assert!(
                text.matches(&judged.claim.id).count() >= 2,
                "in its study and in the matrix: {}",
                judged.claim.id
            );
        }
        for part in ["The sources, figure by figure", "0.02 m/s", "reproduced", "cheapest"] {
            assert!(text.contains(part), "{part}");
        }
    }

    /// Anchors that are linked to exist, once.
    #[test]
    fn links_resolve() {
        let page = index_html(&sample::run());
        let of = |mark: &str| -> Vec<String> {
            page.split(mark)
                .skip(1)
                .map(|rest| rest.split('"').next().unwrap_or_default().to_owned())
                .collect()
        };
        let ids = of(" id=\"");
        let links = of("href=\"#");
        assert!(links.len() > 10);
        for link in links {
            assert_eq!(ids.iter().filter(|id| **id == link).count(), 1, "{link}");
        }
    }

    #[test]
    fn failures_are_named_at_the_top_and_lead_to_their_rows() {
        let page = index_html(&sample::run());
        let (link, row) = ("href=\"#dispersion-constant-m3-fails\"", "id=\"dispersion-constant-m3-fails\"");
        assert!(page.find(link).unwrap() < page.find(row).unwrap());
        assert!(page.contains("3 of 7 claims failed."));
        for verdict in Verdict::ALL {
            assert!(page.contains(&format!(">{}<", verdict.word())), "{verdict:?}");
        }
    }

    #[test]
    fn an_empty_run_says_so() {
        let run = RunSummary { studies: Vec::new(), ..sample::run() };
        assert!(index_html(&run).contains("Nothing was judged."));
    }
}
