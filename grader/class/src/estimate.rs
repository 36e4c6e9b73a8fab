//! `--estimate`: how long a class will take, estimated from the first graded submissions.

use std::time::Duration;

use grader::printing::counted;

/// The numbers of machines to show times for.
const MACHINES: [usize; 6] = [1, 2, 4, 8, 16, 64];
/// The estimate shows the cost for this many submissions, in addition to the cost for the class.
const MANY: f64 = 1e6;

/// The measured times of some submissions, used to estimate the time for the rest.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Estimate {
    /// The time for which each submission in the sample occupied a core.
    pub times: Vec<Duration>,
    /// The number of submissions that are still to be graded.
    pub remaining: usize,
    /// The number of submissions graded at a time.
    pub slots: usize,
}

impl Estimate {
    /// Renders the estimate.
    pub fn render(&self) -> String {
        let count = self.times.len();
        if count == 0 {
            return "\n  nothing to estimate: every submission has been graded\n\n".to_owned();
        }
        let seconds = self.times.iter().sum::<Duration>().as_secs_f64() / count as f64;
        let sample = counted(self.times.len(), "submission");
        let mut text = format!(
            "  \n  estimate from {sample}: {seconds:.1} s per submission on one core\n  \
             {} more submissions, {} at a time:\n",
            self.remaining, self.slots
        );
        for machines in MACHINES {
            // Each submission is graded on one core of one machine.
            let rounds = self.remaining.div_ceil(machines * self.slots);
            let time = format_duration(seconds * rounds as f64);
            let machines = match machines {
                1 => "this machine".to_owned(),
                machines => format!("{machines} machines like this"),
            };
            text += &format!("    {machines:24} {time}\n");
        }
        let hours = MANY * seconds / 3600.0;
        text += &format!("  a million submissions: {hours:.0} core-hours\n");
        text + "  these results are kept; leave out --estimate to grade the rest\n\n"
    }
}

/// Formats a number of seconds in the two largest units.
fn format_duration(seconds: f64) -> String {
    let seconds = seconds.ceil() as u64;
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
