//! The table of all margins, `calibration.md` in the folder of an assignment's solutions.

use std::fmt::Write;
use std::ops::Range;
use std::path::Path;

use anyhow::{Result, bail};
use grader::files;
use grader::handed_out::HandedOut;
use judging::judge::Threshold;

use crate::generated_file::GeneratedFile;
use crate::proof::calibrate::Calibration;
use crate::proof::calibrate::margins::{DeviationSample, MIN_MARGIN, Margin};

/// Builds an assignment's table.
pub fn generated_file(handed_out: &HandedOut, calibration: &Calibration) -> GeneratedFile {
    GeneratedFile::new(path(handed_out), table(calibration))
}

/// Returns the path of an assignment's table, relative to the workspace's root.
fn path(handed_out: &HandedOut) -> String {
    format!("{}/calibration.md", handed_out.solutions())
}

fn table(calibration: &Calibration) -> String {
    let mut text = header(calibration);
    for threshold in measured(calibration) {
        let margin = calibration.margins.margin(threshold);
        writeln!(text, "{}{}", row_start(threshold), row(&margin))
            .expect("writing to a String cannot fail");
    }
    text
}

/// Returns the thresholds that an assignment's exams use.
fn measured(calibration: &Calibration) -> impl Iterator<Item = Threshold> {
    let is_measured = |threshold: &Threshold| {
        let Margin {
            worst_correct,
            mildest_mistake,
        } = calibration.margins.margin(*threshold);
        worst_correct.is_some() || mildest_mistake.is_some()
    };
    Threshold::all().into_iter().filter(is_measured)
}

/// Checks that an assignment's table in the workspace at `root` contains the current value of every
/// threshold that was measured.
pub fn check(root: &Path, handed_out: &HandedOut, calibration: &Calibration) -> Result<()> {
    let path = path(handed_out);
    let table = files::read_to_string(root.join(&path))?;
    let outdated = outdated_thresholds(&table, calibration);
    if !outdated.is_empty() {
        bail!(
            "{path} is out of date for these thresholds: {}; run `cargo author calibrate`",
            outdated.join(", ")
        );
    }
    Ok(())
}

/// Returns the thresholds that were measured but whose current values aren't in the table.
fn outdated_thresholds(table: &str, calibration: &Calibration) -> Vec<&'static str> {
    let is_current = |threshold: &Threshold| {
        let start = row_start(*threshold);
        table.lines().any(|line| line.starts_with(&start))
    };
    let outdated = measured(calibration).filter(|it| !is_current(it));
    outdated.map(Threshold::title).collect()
}

fn header(calibration: &Calibration) -> String {
    format!(
        "# Margins of the thresholds\n\n\
         Written by `cargo author calibrate`: {} correct solutions (`reference/variants`) were \
         graded with the exams of {}, and {} known mistakes (`reference/mistakes`) with the exams \
         of {}.\n\n\
         The judge computes each value as a multiple of the threshold: a value up to 1 is correct. \
         The margin of the worst correct answer is the factor by which the threshold could be made \
         stricter before this answer is judged wrong. The margin of the mildest mistake is the \
         factor by which the threshold could be made more lenient before an item that must catch \
         this mistake stops catching it. `cargo author calibrate --check` fails if a margin is \
         below {MIN_MARGIN}.\n\n\
         - If an item tolerates a number of wrong positions or pixels, that number of the worst \
         positions or pixels is ignored. Such an item catches a mistake only if the mistake \
         exceeds two thresholds: one for the deviation, and one for the number of wrong positions. \
         The table shows whichever of these two values is smaller.\n\
         - For the cost of a tree, only the excess over the cost of the exact sweep's tree is \
         measured: a tree with the same cost has the value 0. Correct builders that do not use the \
         surface area heuristic are left out.\n\
         - If an item catches a mistake by a margin below {MIN_MARGIN} and another item of the \
         same exam catches the mistake clearly, only that other item is measured.\n\
         - There are no thresholds for hits and misses, panics, or the structure of trees. The \
         limits for partial credit are not measured, since they only separate some wrong answers \
         from others.\n\n\
         | threshold | value | defined in | worst correct answer | margin | mildest mistake | margin |\n\
         |---|---|---|---|--:|---|--:|\n",
        calibration.variants,
        seed_range(&calibration.seeds),
        calibration.mistakes,
        seed_range(&calibration.mistake_seeds),
    )
}

fn seed_range(seeds: &Range<u64>) -> String {
    match seeds.end - seeds.start {
        0 => "no seeds".to_owned(),
        1 => format!("seed {}", seeds.start),
        count => format!("{count} seeds ({} to {})", seeds.start, seeds.end - 1),
    }
}

/// Returns the columns of a row that don't depend on the measurement.
fn row_start(threshold: Threshold) -> String {
    format!(
        "| {} | {} | `{}` |",
        threshold.title(),
        threshold.limit(),
        threshold.location()
    )
}

fn row(margin: &Margin) -> String {
    let cell = |sample: &Option<DeviationSample>| match sample {
        None => "none".to_owned(),
        Some(sample) if sample.deviation.value == 0.0 => "0".to_owned(),
        Some(sample) => format!("{}: {sample}", format_number(sample.deviation.value)),
    };
    format!(
        " {} | {} | {} | {} |",
        cell(&margin.worst_correct),
        format_number(margin.correct_margin()),
        cell(&margin.mildest_mistake),
        format_number(margin.mistake_margin()),
    )
}

/// Formats a number with about three significant digits.
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
    use judging::judge::Deviation;

    use super::*;
    use crate::proof::calibrate::margins::Margins;

    fn calibration() -> Calibration {
        let sample = |of: &str, value| DeviationSample {
            deviation: Deviation {
                threshold: Some(Threshold::PictureUv),
                value,
            },
            solution: of.to_owned(),
            item: "sphere.uv".to_owned(),
            seed: 17,
        };
        let mut margins = Margins::default();
        margins.add_correct(sample("sphere.geometric", 0.25));
        margins.add_mistake_of_exam(vec![sample("sphere.u_shifted", 12.3)]);
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
        let table = table(&calibration());
        let row = "| uv in a picture | 2e-3 | `types/uv.rs: TOLERANCE` \
                   | 0.25: `sphere.geometric` in `sphere.uv`, seed 17 | 4.00 \
                   | 12: `sphere.u_shifted` in `sphere.uv`, seed 17 | 12 |\n";
        assert!(table.contains(row), "{table}");
        assert!(table.contains("78 correct solutions"), "{table}");
        assert!(table.contains("200 seeds (0 to 199)"), "{table}");
    }

    #[test]
    fn a_changed_threshold_makes_a_table_outdated() {
        let calibration = calibration();
        let table = table(&calibration);
        assert_eq!(outdated_thresholds(&table, &calibration), [""; 0]);
        let older = table.replace("| uv in a picture | 2e-3 |", "| uv in a picture | 1e-3 |");
        assert_eq!(
            outdated_thresholds(&older, &calibration),
            ["uv in a picture"]
        );
    }

    #[test]
    fn numbers_are_short() {
        let numbers = [0.0, 1e-4, 0.123, 99.5, 1e7, f64::INFINITY].map(format_number);
        assert_eq!(numbers, ["0", "< 0.01", "0.12", "100", "> 1000", "∞"]);
    }
}
