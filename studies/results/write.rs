//! A folder of results, written case by case, so that what is finished need not stay in memory.

use super::read::Source;
use super::{
    CaseResults, FORMAT, FigureResults, File, Folder, RESULTS, Rows, StudyResults, Table, hex, sha256,
};
use crate::manifest::Manifest;
use crate::output::{MARK, Output, Partial};
use crate::run::Ran;
use crate::shard::Shard;
use pd_verify::report::{Drawn, figure_table, verdicts_csv};
use pd_verify::table;
use pd_verify::verdict::Judged;
use sha2::{Digest, Sha256};
use std::collections::HashSet;
use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;

/// A folder that is being written. Nothing is in place before [`Writer::finish`].
pub struct Writer<'a> {
    output: &'a Output,
    name: String,
    folder: Folder,
    partial: Option<Partial>,
    tables: Vec<OpenTable>,
    names: HashSet<String>,
    failed: Option<io::Error>,
}

/// A data file that cases add their rows to.
struct OpenTable {
    name: String,
    columns: String,
    file: Option<BufWriter<fs::File>>,
    hash: Sha256,
}

/// Where a folder was put, and the SHA-256 of its `results.json`.
pub type Placed = io::Result<(PathBuf, String)>;

impl<'a> Writer<'a> {
    pub fn new(output: &'a Output, name: &str, manifest: Manifest, shard: Option<Shard>) -> Self {
        let folder = Folder {
            format: FORMAT,
            manifest,
            shard,
            tables: Vec::new(),
            problems: Vec::new(),
            studies: Vec::new(),
        };
        let names = [MARK, RESULTS, "verdicts.csv"].map(str::to_owned).into();
        let (partial, tables, failed) = (None, Vec::new(), None);
        Self { output, name: name.to_owned(), folder, partial, tables, names, failed }
    }

    /// What could not be drawn before.
    pub fn problems(&mut self, problems: &[String]) {
        self.folder.problems.extend_from_slice(problems);
    }

    /// The cases that follow belong to this study.
    pub fn study(&mut self, study: StudyResults) {
        self.folder.studies.push(study);
    }

    /// Adds what a case brought.
    pub fn case(&mut self, id: &str, inputs: String, ran: Ran) {
        let Ran { judged, tables, figures, files, seconds, .. } = ran;
        let mut found = CaseResults { seconds, judged, ..empty(id, inputs) };
        for figure in figures {
            let drawn = Drawn::new(&figure);
            if let Err(error) = &drawn {
                self.folder.problems.push(format!("figure {}: {error}", figure.id));
            }
            let svg = drawn.ok().map(|drawn| self.file(format!("{}.svg", drawn.id), drawn.svg.as_bytes()));
            let data = figure_table(&figure);
            let csv = self.file(data.file.clone(), data.csv().as_bytes());
            let (id, title, caption) = (figure.id, figure.title, figure.caption);
            found.figures.push(FigureResults { id, title, caption, svg, csv });
        }
        for file in files {
            let written = self.file(file.name.clone(), &file.bytes());
            found.files.push(written);
        }
        for table in tables {
            let rows = self.table(&table);
            found.add(rows);
        }
        self.push(found);
    }

    /// Adds a case as an earlier run found it, byte for byte.
    ///
    /// # Errors
    /// When a file of the case cannot be read or is not what was written.
    pub fn take_over(&mut self, source: &Source, study: &str, case: &CaseResults) -> io::Result<()> {
        let files: Vec<(&File, Vec<u8>)> =
            case.files().map(|file| Ok((file, source.file(file)?))).collect::<io::Result<_>>()?;
        let rows: Vec<(String, Vec<u8>)> = case
            .rows
            .iter()
            .map(|rows| Ok((source.columns(&rows.file)?, source.rows(study, &case.id, &rows.file)?)))
            .collect::<io::Result<_>>()?;
        for (file, bytes) in files {
            self.file(file.name.clone(), &bytes);
        }
        for ((columns, bytes), rows) in rows.into_iter().zip(&case.rows) {
            self.rows(&rows.file, &columns, &bytes);
        }
        self.push(case.clone());
        Ok(())
    }

    fn push(&mut self, case: CaseResults) {
        if let Some(study) = self.folder.studies.last_mut() {
            study.cases.push(case);
        }
    }

    fn file(&mut self, name: String, bytes: &[u8]) -> File {
        if !self.names.insert(name.clone()) {
            self.folder.problems.push(format!("two results would be called {name}"));
        }
        let written = self.place(&name).and_then(|place| fs::write(place, bytes));
        self.note(written);
        File { sha256: sha256(bytes), name }
    }

    fn table(&mut self, table: &table::Table) -> Rows {
        let text = table.csv();
        let (columns, rows) = text.split_once('\n').unwrap_or((&text, ""));
        self.rows(&table.file, columns, rows.as_bytes());
        Rows { file: table.file.clone(), bytes: rows.len() as u64 }
    }

    fn rows(&mut self, name: &str, columns: &str, rows: &[u8]) {
        let known = self.tables.iter().position(|table| table.name == name);
        let index = known.unwrap_or_else(|| {
            self.open(name, columns);
            self.tables.len() - 1
        });
        let table = &mut self.tables[index];
        assert_eq!(table.columns, columns, "{name} has two kinds of row");
        let written = table.add(rows);
        self.note(written);
    }

    fn open(&mut self, name: &str, columns: &str) {
        if !self.names.insert(name.to_owned()) {
            self.folder.problems.push(format!("two results would be called {name}"));
        }
        let made = self.place(name).and_then(fs::File::create).map(BufWriter::new);
        let (file, made) = made.map_or_else(|error| (None, Err(error)), |file| (Some(file), Ok(())));
        self.note(made);
        let (name, columns) = (name.to_owned(), columns.to_owned());
        let mut table = OpenTable { name, columns, file, hash: Sha256::new() };
        let head = table.columns.clone() + "\n";
        let written = table.add(head.as_bytes());
        self.tables.push(table);
        self.note(written);
    }

    /// Where a file is to be written; the folder is made when there is something to put in.
    fn place(&mut self, name: &str) -> io::Result<PathBuf> {
        if self.failed.is_some() {
            return Err(io::Error::other("an earlier file could not be written"));
        }
        if self.partial.is_none() {
            let partial = self.output.partial(&self.name)?;
            fs::write(partial.path(MARK), self.folder.manifest.json())?;
            self.partial = Some(partial);
        }
        let partial = self.partial.as_ref();
        Ok(partial.map(|partial| partial.path(name)).unwrap_or_default())
    }

    /// Keeps the first error; what was written until then goes, what is found later is judged all the same.
    fn note(&mut self, written: io::Result<()>) {
        if let (Err(error), None) = (written, &self.failed) {
            self.failed = Some(error);
            self.tables.iter_mut().for_each(|table| table.file = None);
            self.partial = None;
        }
    }

    /// Cases that were added.
    pub fn len(&self) -> usize {
        self.folder.cases().count()
    }

    /// What was found in the study at hand.
    pub fn judged_last(&self) -> impl Iterator<Item = &Judged> {
        self.folder.studies.last().into_iter().flat_map(|study| &study.cases).flat_map(|case| &case.judged)
    }

    /// Puts the folder in place.
    pub fn finish(mut self) -> (Folder, Placed) {
        for index in 0..self.tables.len() {
            let flushed = self.tables[index].file.take().map_or(Ok(()), |mut file| file.flush());
            self.note(flushed);
        }
        let tables = std::mem::take(&mut self.tables).into_iter().map(OpenTable::closed);
        self.folder.tables = tables.collect();
        let placed = self.last_files();
        (self.folder, placed)
    }

    fn last_files(&mut self) -> Placed {
        if let Some(error) = self.failed.take() {
            return Err(error);
        }
        let judged: Vec<Judged> = self.folder.judged().cloned().collect();
        fs::write(self.place("verdicts.csv")?, verdicts_csv(&judged))?;
        drop(judged);
        let mut file = BufWriter::new(fs::File::create(self.place(RESULTS)?)?);
        let mut hashed = Hashing { hash: Sha256::new(), to: &mut file };
        serde_json::to_writer_pretty(&mut hashed, &self.folder)?;
        hashed.write_all(b"\n")?;
        let sha256 = hex(&hashed.hash.finalize());
        file.flush()?;
        drop(file);
        match self.partial.take() {
            Some(partial) => Ok((partial.commit()?, sha256)),
            None => Err(io::Error::other("nothing was written")),
        }
    }
}

fn empty(id: &str, inputs: String) -> CaseResults {
    CaseResults {
        id: id.to_owned(),
        inputs,
        seconds: 0.0,
        judged: Vec::new(),
        figures: Vec::new(),
        rows: Vec::new(),
        files: Vec::new(),
    }
}

impl CaseResults {
    /// Rows of one file stand together.
    fn add(&mut self, rows: Rows) {
        match self.rows.iter_mut().find(|other| other.file == rows.file) {
            Some(other) => other.bytes += rows.bytes,
            None => self.rows.push(rows),
        }
    }
}

impl OpenTable {
    fn add(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hash.update(bytes);
        self.file.as_mut().map_or(Ok(()), |file| file.write_all(bytes))
    }

    fn closed(self) -> Table {
        Table { columns: self.columns, file: File { name: self.name, sha256: hex(&self.hash.finalize()) } }
    }
}

/// Bytes on their way to a file.
struct Hashing<'a, W> {
    hash: Sha256,
    to: &'a mut W,
}

impl<W: Write> Write for Hashing<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes)?;
        self.hash.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.to.flush()
    }
}
