//! `verdicts.csv`: one line per claim, all digits.

use super::number::csv_number;
use super::row::note;
use crate::verdict::Judged;

const COLUMNS: [&str; 21] = [
    "claim",
    "study",
    "case",
    "quantity",
    "unit",
    "computed",
    "reference",
    "error",
    "error_kind",
    "relation",
    "tolerance",
    "basis",
    "order",
    "order_low",
    "order_high",
    "order_levels",
    "expected_order",
    "verdict",
    "note",
    "source",
    "seconds",
];

/// The table as CSV with a header; a number that is unknown or not finite is an empty cell.
pub fn verdicts_csv(judged: &[Judged]) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Every record has as many cells as the header and memory takes every byte: writing cannot fail.
    writer.write_record(COLUMNS).expect("a header in memory");
    for one in judged {
        writer.write_record(cells(one)).expect("a record in memory");
    }
    let bytes = writer.into_inner().expect("a table in memory");
    String::from_utf8(bytes).expect("made of strings")
}

fn cells(judged: &Judged) -> [String; 21] {
    let (claim, evidence) = (&judged.claim, &judged.evidence);
    let number = |value: Option<f64>| value.map(csv_number).unwrap_or_default();
    let interval = evidence.order.and_then(|order| order.interval);
    [
        claim.id.clone(),
        claim.study.clone(),
        claim.case.clone(),
        claim.quantity.clone(),
        claim.unit.clone(),
        number(evidence.computed),
        number(evidence.reference),
        number(evidence.error),
        claim.error_kind.word().to_owned(),
        claim.relation.word().to_owned(),
        csv_number(claim.tolerance),
        claim.basis.word().to_owned(),
        number(evidence.order.map(|order| order.value)),
        number(interval.map(|(low, _)| low)),
        number(interval.map(|(_, high)| high)),
        evidence.order.map(|order| order.levels.to_string()).unwrap_or_default(),
        number(claim.expected_order),
        judged.verdict.word().to_owned(),
        note(judged),
        claim.source.clone(),
        number(evidence.seconds),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn the_columns_are_those_of_the_contract() {
        let table = verdicts_csv(&[]);
        assert_eq!(
            table,
            "claim,study,case,quantity,unit,computed,reference,error,error_kind,relation,tolerance,basis,order,\
             order_low,order_high,order_levels,expected_order,verdict,note,source,seconds\n"
        );
    }

    #[test]
    fn numbers_read_back_and_the_unknown_is_empty() {
        let judged = sample::judged();
        let table = verdicts_csv(&judged);
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows.len(), judged.len());
        for (row, one) in rows.iter().zip(&judged) {
            assert_eq!(row.len(), 21);
            assert_eq!(row[7].parse::<f64>().ok(), one.evidence.error);
            assert_eq!(&row[17], one.verdict.word());
        }
        assert_eq!((&rows[0][12], &rows[0][13], &rows[0][14], &rows[0][15]), ("1.98", "1.9", "2.06", "5"));
        assert_eq!((&rows[5][5], &rows[5][12], &rows[5][18]), ("", "", "not finite after step 12"));
    }
}
