//! The table of all margins, for people.

use std::fmt::Write;
use std::ops::Range;
use std::path::Path;

use grader::judge::Threshold;

use crate::generated::Generated;
use crate::proof::calibrate::Calibration;
use crate::proof::calibrate::margins::{ENOUGH, Margin, Sighting};
use crate::proof::sources::{Unreadable, read};

/// Where the table stands.
pub const PATH: &str = "reference/calibration.md";

/// The table.
pub fn generated(calibration: &Calibration) -> Generated {
    let mut text = head(calibration);
    for threshold in Threshold::ALL {
        let margin = calibration.margins.of(threshold);
        writeln!(text, "{}{}", begins(threshold), row(&margin)).expect("text takes text");
    }
    Generated::new(PATH, text)
}

/// Why a table does not tell of the thresholds as they are.
#[derive(Debug, thiserror::Error)]
pub enum OldTable {
    /// It can not be read.
    #[error(transparent)]
    Unreadable(#[from] Unreadable),
    /// Thresholds were moved since.
    #[error(
        "{PATH} was measured before these were as they are now: {}\nmeasure them with \
         `cargo author calibrate`",
        .0.join(", ")
    )]
    Moved(Vec<&'static str>),
}

/// Checks that the table of the workspace at `root` tells of every threshold as it is.
pub fn check(root: &Path) -> Result<(), OldTable> {
    match missing(&read(&root.join(PATH))?) {
        missing if missing.is_empty() => Ok(()),
        missing => Err(OldTable::Moved(missing)),
    }
}

/// The thresholds of which this table does not tell, as they are now.
fn missing(table: &str) -> Vec<&'static str> {
    let told = |threshold: &Threshold| {
        let begins = begins(*threshold);
        table.lines().any(|line| line.starts_with(&begins))
    };
    let missing = Threshold::ALL.into_iter().filter(|it| !told(it));
    missing.map(Threshold::title).collect()
}

fn head(calibration: &Calibration) -> String {
    format!(
        "# How far the thresholds stand from right and wrong\n\n\
         Written by `cargo author calibrate`: {} right solutions (`reference/variants`) in the exams \
         of {}, {} known mistakes (`reference/mistakes`) in those of {}.\n\n\
         Values are multiples of the threshold, as the judge itself tells them: up to 1 is right. A \
         margin is the factor by which the threshold could be moved: made stricter before the first \
         right answer is wrong, or more lenient before a mistake is not told by an item that it must \
         fail. Below {ENOUGH} on either side, `cargo author calibrate --check` fails.\n\n\
         - Where positions or pixels are counted, as many of the worst as may be wrong are passed \
         over, and a mistake is held against what tells it less: how far off, or at how many places.\n\
         - What a tree costs beyond the exact sweep's tree counts: at the same cost it is at 0. Right \
         trees that are not the surface area heuristic's are not held against it.\n\
         - Hit or miss, panics and the structure of trees know no threshold. The steps of partial \
         credit stand between wrong and wrong.\n\n\
         | threshold | value | stands in | worst right answer | margin | mildest mistake | margin |\n\
         |---|---|---|---|--:|---|--:|\n",
        calibration.variants,
        seeds(&calibration.seeds),
        calibration.mistakes,
        seeds(&calibration.seeds_of_mistakes),
    )
}

fn seeds(seeds: &Range<u64>) -> String {
    match seeds.end - seeds.start {
        0 => "no seed".to_owned(),
        1 => format!("seed {}", seeds.start),
        count => format!("{count} seeds ({} to {})", seeds.start, seeds.end - 1),
    }
}

/// What does not depend on what was measured.
fn begins(threshold: Threshold) -> String {
    format!(
        "| {} | {} | `{}` |",
        threshold.title(),
        threshold.limit(),
        threshold.place()
    )
}

fn row(margin: &Margin) -> String {
    let sighting = |sighting: &Option<Sighting>| match sighting {
        None => "none".to_owned(),
        Some(sighting) if sighting.deviation.value == 0.0 => "0".to_owned(),
        Some(sighting) => format!("{}: {sighting}", number(sighting.deviation.value)),
    };
    format!(
        " {} | {} | {} | {} |",
        sighting(&margin.worst),
        number(margin.of_right()),
        sighting(&margin.mildest),
        number(margin.of_wrong()),
    )
}

/// As exactly as anybody wants to know.
fn number(value: f64) -> String {
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
        let sighting = |of: &str, value| Sighting {
            deviation: Deviation {
                threshold: Some(Threshold::Uv),
                value,
            },
            of: of.to_owned(),
            item: "sphere.uv".to_owned(),
            seed: 17,
        };
        let mut margins = Margins::default();
        margins.add_right(sighting("sphere.geometric", 0.25));
        margins.add_wrong(sighting("sphere.u_shifted", 12.3));
        Calibration {
            seeds: 0..200,
            seeds_of_mistakes: 0..3,
            variants: 78,
            mistakes: 209,
            margins,
        }
    }

    #[test]
    fn a_row_tells_both_sides_and_where() {
        let table = generated(&calibration()).contents;
        let row = "| uv of a hit | 2e-3 | `measure.rs: UV` \
                   | 0.25: `sphere.geometric` in `sphere.uv`, seed 17 | 4.00 \
                   | 12: `sphere.u_shifted` in `sphere.uv`, seed 17 | 12 |\n";
        assert!(table.contains(row), "{table}");
        assert!(table.contains("78 right solutions"), "{table}");
        assert!(table.contains("200 seeds (0 to 199)"), "{table}");
    }

    #[test]
    fn a_threshold_that_was_moved_is_missing_from_an_older_table() {
        let table = generated(&calibration()).contents;
        assert_eq!(missing(&table), [""; 0]);
        let older = table.replace("| uv of a hit | 2e-3 |", "| uv of a hit | 1e-3 |");
        assert_eq!(missing(&older), ["uv of a hit"]);
    }

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 1e-4, 0.123, 99.5, 1e7, f64::INFINITY].map(number);
        assert_eq!(numbers, ["0", "< 0.01", "0.12", "100", "> 1000", "∞"]);
    }
}
