//! `--estimate`: how long a class will take, estimated from the first graded submissions.

use std::time::Duration;

use grader::printing::counted;

/// The numbers of machines to show times for.
const MACHINES: [usize; 6] = [1, 2, 4, 8, 16, 64];
/// The number of submissions to show the cost of, in addition to the class.
const MANY: f64 = 1e6;

/// The measured times of some submissions, used to estimate the rest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// The time each submission in the sample occupied a core.
    pub times: Vec<Duration>,
    /// The number of submissions that are still to be graded.
    pub remaining: usize,
    /// The number of submissions graded at a time.
    pub slots: usize,
}

impl Estimate {
    /// Returns the mean time per submission on one core, or `None` if nothing was measured.
    fn mean(&self) -> Option<Duration> {
        let count = u32::try_from(self.times.len()).ok()?;
        self.times.iter().sum::<Duration>().checked_div(count)
    }

    /// Returns the time that this many machines like this one take for the rest. Each submission is
    /// graded on one core of one machine.
    fn remaining_time(&self, mean: Duration, machines: usize) -> Duration {
        let rounds = self.remaining.div_ceil(machines * self.slots);
        mean * u32::try_from(rounds).unwrap_or(u32::MAX)
    }

    /// Renders the estimate.
    pub fn render(&self) -> String {
        let Some(mean) = self.mean() else {
            return "\n  nothing to estimate: every submission is graded\n\n".to_owned();
        };
        let seconds = mean.as_secs_f64();
        let sample = counted(self.times.len(), "submission");
        let mut text = format!(
            "  \n  estimate from {sample}: {seconds:.1} s per submission on one core\n  \
             {} more submissions, {} at a time:\n",
            self.remaining, self.slots
        );
        for machines in MACHINES {
            let time = format_duration(self.remaining_time(mean, machines));
            let machines = match machines {
                1 => "this machine".to_owned(),
                machines => format!("{machines} machines like this"),
            };
            text += &format!("    {machines:24} {time}\n");
        }
        let hours = MANY * seconds / 3600.0;
        text += &format!("  a million submissions: {hours:.0} core-hours\n");
        text + "  the results are kept: without --estimate, the rest is graded\n\n"
    }
}

/// Formats a duration in its two largest units.
fn format_duration(duration: Duration) -> String {
    let seconds = duration.as_secs_f64().ceil() as u64;
    match (seconds / 3600, seconds / 60 % 60, seconds % 60) {
        (0, 0, seconds) => format!("{seconds} s"),
        (0, minutes, seconds) => format!("{minutes} min {seconds} s"),
        (hours, minutes, _) => format!("{hours} h {minutes} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rest_is_divided_among_cores_and_machines() {
        let estimate = Estimate {
            times: [1500, 500, 2500, 1500].map(Duration::from_millis).to_vec(),
            remaining: 9_999,
            slots: 2,
        };
        insta::assert_snapshot!(estimate.render());
        let done = Estimate {
            times: Vec::new(),
            ..estimate
        };
        assert!(done.render().contains("nothing to estimate"));
    }
}
