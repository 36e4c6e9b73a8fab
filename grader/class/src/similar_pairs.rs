//! Reads the pairs of files that a similarity checker found similar. The checker compared the
//! numbered files that `--similarity-input` wrote, and the key next to the folder of these files
//! says whose they are.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::fmt::Display;
use std::path::{Path, PathBuf};

use grader::files;
use grader::submission::{Archive, ArchiveLimits};
use serde_json::Value;

use crate::cli::Lists;
use crate::error::Error;
use crate::paths::beside;
use crate::table::Table;

/// Two similar files. They don't affect anybody's points.
#[derive(Clone, Debug, PartialEq)]
pub struct SimilarPair {
    /// The similarity according to the checker, from 0 to 1.
    pub similarity: f64,
    /// The files, which belong to the same task.
    pub files: [ComparedFile; 2],
}

/// A file that the checker compared.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ComparedFile {
    /// The task file's name, without its extension.
    pub task: String,
    /// The submission's id from the key, in a form that is safe in a table's cell.
    pub submission: String,
    /// The path of the file with the students' own lines.
    pub path: PathBuf,
    /// The students' own lines.
    pub lines: String,
}

/// The titles of the columns that contain the two names and the similarity: first those in Dolos's
/// `pairs.csv`, then those in the `results.csv` that JPlag's `--csv-export` writes.
const COLUMNS: [[&str; 3]; 2] = [
    ["leftFilePath", "rightFilePath", "similarity"],
    ["submissionName1", "submissionName2", "averageSimilarity"],
];
/// The maximum size of a file in JPlag's archive, in bytes.
const MAX_JSON_BYTES: u64 = 256 << 20;
/// The maximum number of pairs. Checkers list every pair in a class, but nobody would compare more
/// than this many.
const MAX_PAIRS: usize = 20;

/// Reads the most similar pairs from all results that `--similar` names.
pub fn read_similar_pairs(lists: &Lists) -> Result<Vec<SimilarPair>, Error> {
    let mut pairs: Vec<SimilarPair> = Vec::new();
    for [folder, results] in lists.similar.as_chunks().0 {
        pairs.extend(read_results(folder, results)?);
    }
    pairs.sort_by(|one, other| other.similarity.total_cmp(&one.similarity));
    pairs.truncate(MAX_PAIRS);
    for file in pairs.iter_mut().flat_map(|pair| &mut pair.files) {
        file.lines = files::read_to_string(&file.path).map_err(Error::user)?;
    }
    Ok(pairs)
}

/// A row of results, numbered as in spreadsheets: the names of two files and their similarity.
type ResultRow = (usize, [String; 3]);

/// Reads the rows of a table from Dolos or JPlag.
fn read_table(results: &Path) -> Result<Vec<ResultRow>, Error> {
    let (table, shown) = (Table::read(results)?, results.display());
    let columns = COLUMNS.map(|names| names.map(|name| table.column(name)));
    let columns = columns.into_iter().find(|all| !all.contains(&None));
    let columns = columns.ok_or_else(|| {
        Error::user(format!(
            "{shown} is neither Dolos's pairs.csv nor JPlag's results.csv: pass one of these"
        ))
    })?;
    let rows = table.numbered_rows().map(|(number, row)| {
        let cell = |column: Option<usize>| column.map_or("", |column| row[column].trim());
        (number, columns.map(|column| cell(column).to_owned()))
    });
    Ok(rows.collect())
}

/// Reads the comparisons in JPlag's archive. Since version 6, they are in a separate file. Before
/// that, they were in the overview.
fn read_archive(results: &Path) -> Result<Vec<ResultRow>, Error> {
    let refused = |why: &dyn Display| Error::user(format!("{}: {why}", results.display()));
    let archive = Archive::open(results, ArchiveLimits::class());
    let mut archive = archive.map_err(|why| refused(&why))?;
    let members = archive.listing().map_err(|why| refused(&why))?.members;
    let mut read = |name: &str| {
        let Some(member) = members.iter().find(|member| member.path == name) else {
            return Ok(Value::Null);
        };
        let bytes = archive.read(&[member], MAX_JSON_BYTES);
        let bytes = bytes.map_err(|why| refused(&why))?.concat();
        serde_json::from_slice(&bytes).map_err(|why| refused(&format!("{name}: {why}")))
    };
    let overview = read("overview.json")?;
    let (comparisons, mappings) = (
        read("topComparisons.json")?,
        read("submissionMappings.json")?,
    );
    let comparisons = comparisons.as_array();
    let comparisons = comparisons.or(overview["top_comparisons"].as_array());
    let missing = "it contains no comparisons in the format of JPlag 5 or 6: pass JPlag's result \
                   archive";
    let comparisons = comparisons.ok_or_else(|| refused(&missing))?.iter();
    // Ids are names without slashes.
    let names = [
        &mappings["submissionIds"],
        &overview["submission_id_to_display_name"],
    ];
    let rows = comparisons.map(|comparison| {
        let name = |keys: [&str; 2]| {
            let id = keys.iter().find_map(|key| comparison[*key].as_str());
            let id = id.unwrap_or_default();
            let name = names.iter().find_map(|names| names[id].as_str());
            name.unwrap_or(id).to_owned()
        };
        [
            name(["firstSubmission", "first_submission"]),
            name(["secondSubmission", "second_submission"]),
            comparison["similarities"]["AVG"].to_string(),
        ]
    });
    Ok((1..).zip(rows).collect())
}

/// Reads the pairs in a file of results, but not yet the students' lines. Leaves out pairs of files
/// from different tasks.
fn read_results(folder: &Path, results: &Path) -> Result<Vec<SimilarPair>, Error> {
    let (key, shown) = (read_key(folder)?, results.display());
    let extension = results.extension().and_then(OsStr::to_str);
    let rows = match extension {
        Some("zip" | "jplag") => read_archive(results),
        _ => read_table(results),
    };
    let mut pairs = Vec::new();
    for (number, [one, other, similarity]) in rows? {
        let error = |problem: &str| Error::user(format!("{shown}, row {number}: {problem}"));
        let files = [&one, &other].map(|name| find_compared(name, folder, results, &key));
        let [Some(left), Some(right)] = files else {
            return Err(error(&format!(
                "{one:?} or {other:?} is not a task file in {}: pass the folder that was compared, \
                 and put each task's results into a folder with the task's name, such as sphere",
                folder.display()
            )));
        };
        let parsed = similarity.parse().ok();
        let Some(similarity) = parsed.filter(|number| (0.0..=1.0).contains(number)) else {
            return Err(error(
                "the similarity is not between 0 and 1: export the file again",
            ));
        };
        if left.task == right.task {
            let files = [left, right];
            pairs.push(SimilarPair { similarity, files });
        }
    }
    Ok(pairs)
}

/// The ids of the submissions, keyed by number. The keys aren't text, since spreadsheets drop
/// leading zeros.
type Key = HashMap<u32, String>;

/// Reads the key next to a folder of compared files.
fn read_key(folder: &Path) -> Result<Key, Error> {
    let path = beside(folder, "key.csv");
    let table = Table::read(&path).map_err(|error| {
        Error::user(format!(
            "{error}; pass the folder that --similarity-input created"
        ))
    })?;
    let entry = |row: &Vec<String>| Some((row.first()?.parse().ok()?, row.get(1)?.clone()));
    Ok(table.rows.iter().filter_map(entry).collect())
}

/// Finds a file by the checker's name for it. If this name doesn't contain the task, the name of
/// the folder with the results is used as the task.
fn find_compared(name: &str, folder: &Path, results: &Path, key: &Key) -> Option<ComparedFile> {
    let name = PathBuf::from(name.replace('\\', "/"));
    let number = name.file_stem()?.to_str()?.parse().ok()?;
    let submission = key.get(&number)?.clone();
    let parent = |path: &Path| Some(path.parent()?.file_name()?.to_str()?.to_owned());
    let tasks = [parent(&name), parent(results)].into_iter().flatten();
    let files = tasks.filter_map(|task| Some((folder.join(&task).join(name.file_name()?), task)));
    let (path, task) = files.into_iter().find(|(path, _)| path.is_file())?;
    Some(ComparedFile {
        task,
        submission,
        path,
        lines: String::new(),
    })
}
