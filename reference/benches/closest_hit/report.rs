//! The tables for one mesh: the measurements and the ratios.

use std::fmt;

use crate::cost::Spread;

/// The measurements, in the order they were made.
#[derive(Default)]
pub struct Report {
    names: Vec<&'static str>,
    columns: Vec<&'static str>,
    /// For each name and column, one value per round.
    cells: Vec<(&'static str, &'static str, Vec<f64>)>,
    /// The fraction of rays for which a contender and the reference found different hits: the
    /// maximum over all contenders and rounds.
    differing: f64,
    most_differing: &'static str,
}

/// The columns that show rays per second.
const RAYS: [&str; 3] = ["primary", "bounce", "random"];
const BUILD: &str = "build, ms";

impl Report {
    pub fn add(&mut self, name: &'static str, column: &'static str, rounds: Vec<f64>) {
        if !self.names.contains(&name) {
            self.names.push(name);
        }
        if !self.columns.contains(&column) {
            self.columns.push(column);
        }
        self.cells.push((name, column, rounds));
    }

    pub fn record_mismatches(&mut self, name: &'static str, share: f64) {
        if share > self.differing {
            self.differing = share;
            self.most_differing = name;
        }
    }

    fn rounds(&self, name: &str, column: &str) -> Option<&[f64]> {
        let mut cells = self.cells.iter();
        let cell = cells.find(|cell| (cell.0, cell.1) == (name, column));
        cell.map(|cell| cell.2.as_slice())
    }

    fn cell(&self, name: &str, column: &str) -> Option<Spread> {
        let rounds = self.rounds(name, column)?;
        Some(Spread::of(rounds.iter().copied()))
    }

    /// Returns the median, over all rounds, of the ratio between two contenders' values. The ratio
    /// of their medians would be less reliable, since all contenders are slow in a slow round.
    fn ratio(&self, column: &str, name: &str, other: &str) -> Option<f64> {
        let rounds = self.rounds(name, column)?.iter();
        let ratios = rounds.zip(self.rounds(other, column)?).map(|(a, b)| a / b);
        Some(Spread::of(ratios).median)
    }

    /// Returns, for each kind of ray, the speed of a contender relative to the fastest of the other
    /// contenders.
    fn speedups(&self, name: &str, others: &[&str]) -> Option<[f64; 3]> {
        let mut ratios = [0.0; 3];
        for (ratio, kind) in ratios.iter_mut().zip(RAYS) {
            let others = others
                .iter()
                .filter_map(|other| self.ratio(kind, name, other));
            *ratio = others.min_by(f64::total_cmp)?;
        }
        Some(ratios)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:14}", "")?;
        for column in &self.columns {
            write!(f, "{column:>22}")?;
        }
        writeln!(f)?;
        for name in &self.names {
            write!(f, "{name:14}")?;
            for column in &self.columns {
                let cell = self.cell(name, column).map(|spread| {
                    let digits = if *column == BUILD { 1 } else { 2 };
                    let Spread {
                        median,
                        least,
                        greatest,
                    } = spread;
                    format!("{median:.digits$} ({least:.digits$}–{greatest:.digits$})")
                });
                write!(f, "{:>22}", cell.unwrap_or_default())?;
            }
            writeln!(f)?;
        }
        writeln!(
            f,
            "rays: millions per second, median (least–greatest); at most {:.4}% of the hits differ ({})\n",
            100.0 * self.differing,
            self.most_differing
        )?;
        for (name, others) in [
            ("reference", &["obvhs"][..]),
            ("reference", &["bvh, nearest", "bvh, all"]),
            ("wide", &["reference"]),
            ("wide", &["Embree"]),
        ] {
            let Some(rays) = self.speedups(name, others) else {
                continue;
            };
            let mean = rays.iter().product::<f64>().cbrt();
            let [primary, bounce, random] = rays;
            write!(
                f,
                "{name} / {}: primary {primary:.2}, bounce {bounce:.2}, random {random:.2}; geometric mean {mean:.2}",
                others[0]
            )?;
            match self.ratio(BUILD, name, others[0]) {
                Some(build) => writeln!(f, "; build time {build:.2}")?,
                None => writeln!(f)?,
            }
        }
        Ok(())
    }
}
