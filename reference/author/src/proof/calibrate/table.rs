//! The table of all margins, for people.

use std::fmt::Write;
use std::ops::Range;
use std::path::Path;

use grader::judge::Threshold;

use crate::generated_file::GeneratedFile;
use crate::proof::calibrate::Calibration;
use crate::proof::calibrate::margins::{DeviationSample, MIN_MARGIN, Margin};
use crate::proof::sources::{ReadError, read};

/// Where the table stands.
pub const PATH: &str = "reference/calibration.md";

/// The table.
pub fn generated_file(calibration: &Calibration) -> GeneratedFile {
    let mut text = header(calibration);
    for threshold in Threshold::ALL {
        let margin = calibration.margins.margin(threshold);
        writeln!(text, "{}{}", row_start(threshold), row(&margin)).expect("text takes text");
    }
    GeneratedFile::new(PATH, text)
}

/// Why a table does not tell of the thresholds as they are.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// It can not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Thresholds were moved since.
    #[error(
        "{PATH} was measured before these were as they are now: {}\nmeasure them with \
         `cargo author calibrate`",
        .0.join(", ")
    )]
    Outdated(Vec<&'static str>),
}

/// Checks that the table of the workspace at `root` tells of every threshold as it is.
pub fn check(root: &Path) -> Result<(), TableError> {
    match outdated_thresholds(&read(&root.join(PATH))?) {
        missing if missing.is_empty() => Ok(()),
        missing => Err(TableError::Outdated(missing)),
    }
}

/// The thresholds of which this table does not tell, as they are now.
fn outdated_thresholds(table: &str) -> Vec<&'static str> {
    let told = |threshold: &Threshold| {
        let begins = row_start(*threshold);
        table.lines().any(|line| line.starts_with(&begins))
    };
    let missing = Threshold::ALL.into_iter().filter(|it| !told(it));
    missing.map(Threshold::title).collect()
}

fn header(calibration: &Calibration) -> String {
    format!(
        "# How far the thresholds stand from right and wrong\n\n\
         Written by `cargo author calibrate`: {} right solutions (`reference/variants`) in the exams \
         of {}, {} known mistakes (`reference/mistakes`) in those of {}.\n\n\
         Values are multiples of the threshold, as the judge itself tells them: up to 1 is right. A \
         margin is the factor by which the threshold could be moved: made stricter before the first \
         right answer is wrong, or more lenient before a mistake is not told by an item that it must \
         fail. Below {MIN_MARGIN} on either side, `cargo author calibrate --check` fails.\n\n\
         - Where positions or pixels are counted, as many of the worst as may be wrong are passed \
         over, and a mistake is held against what tells it less: how far off, or at how many places.\n\
         - What a tree costs beyond the exact sweep's tree counts: at the same cost it is at 0. Right \
         trees that are not the surface area heuristic's are not held against it.\n\
         - Hit or miss, panics and the structure of trees know no threshold. The steps of partial \
         credit stand between wrong and wrong.\n\n\
         | threshold | value | stands in | worst right answer | margin | mildest mistake | margin |\n\
         |---|---|---|---|--:|---|--:|\n",
        calibration.variants,
        seed_range(&calibration.seeds),
        calibration.mistakes,
        seed_range(&calibration.mistake_seeds),
    )
}

fn seed_range(seeds: &Range<u64>) -> String {
    match seeds.end - seeds.start {
        0 => "no seed".to_owned(),
        1 => format!("seed {}", seeds.start),
        count => format!("{count} seeds ({} to {})", seeds.start, seeds.end - 1),
    }
}

/// What does not depend on what was measured.
fn row_start(threshold: Threshold) -> String {
    format!(
        "| {} | {} | `{}` |",
        threshold.title(),
        threshold.limit(),
        threshold.location()
    )
}

fn row(margin: &Margin) -> String {
    let sighting = |sighting: &Option<DeviationSample>| match sighting {
        None => "none".to_owned(),
        Some(sighting) if sighting.deviation.value == 0.0 => "0".to_owned(),
        Some(sighting) => format!("{}: {sighting}", format_number(sighting.deviation.value)),
    };
    format!(
        " {} | {} | {} | {} |",
        sighting(&margin.worst_correct),
        format_number(margin.correct_margin()),
        sighting(&margin.mildest_mistake),
        format_number(margin.mistake_margin()),
    )
}

/// As exactly as anybody wants to know.
fn format_number(value: f64) -> String {
    match value {
        value if value.is_infinite() => "∞".to_owned(),
        0.0 => "0".to_owned(),
        value if value < 0.01 => "< 0.01".to_owned(),
        value if value < 10.0 => format!("{value:.2}"),
        value if value < 1000.0 => format!("{value:.0}"),
        _ => "> 1000".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use grader::judge::Deviation;

    use super::*;
    use crate::proof::calibrate::margins::Margins;

    fn calibration() -> Calibration {
        let sighting = |of: &str, value| DeviationSample {
            deviation: Deviation {
                threshold: Some(Threshold::Uv),
                value,
            },
            solution: of.to_owned(),
            item: "sphere.uv".to_owned(),
            seed: 17,
        };
        let mut margins = Margins::default();
        margins.add_correct(sighting("sphere.geometric", 0.25));
        margins.add_mistake(sighting("sphere.u_shifted", 12.3));
        Calibration {
            seeds: 0..200,
            mistake_seeds: 0..3,
            variants: 78,
            mistakes: 209,
            margins,
        }
    }

    #[test]
    fn a_row_shows_both_margins_and_their_solutions() {
        let table = generated_file(&calibration()).contents;
        let row = "| uv of a hit | 2e-3 | `measure.rs: UV` \
                   | 0.25: `sphere.geometric` in `sphere.uv`, seed 17 | 4.00 \
                   | 12: `sphere.u_shifted` in `sphere.uv`, seed 17 | 12 |\n";
        assert!(table.contains(row), "{table}");
        assert!(table.contains("78 right solutions"), "{table}");
        assert!(table.contains("200 seeds (0 to 199)"), "{table}");
    }

    #[test]
    fn a_changed_threshold_makes_a_table_outdated() {
        let table = generated_file(&calibration()).contents;
        assert_eq!(outdated_thresholds(&table), [""; 0]);
        let older = table.replace("| uv of a hit | 2e-3 |", "| uv of a hit | 1e-3 |");
        assert_eq!(outdated_thresholds(&older), ["uv of a hit"]);
    }

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 1e-4, 0.123, 99.5, 1e7, f64::INFINITY].map(format_number);
        assert_eq!(numbers, ["0", "< 0.01", "0.12", "100", "> 1000", "∞"]);
    }
}
