//! Faults: the reasons why a probe gives no answer.

use std::fmt;

use judging::signatures::NoAnswerReason;

/// The reason for a missing answer. After a fault, the probe ends and the item fails.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The item exceeded a time limit.
    TimedOut(TimeLimit),
    /// The memory limit was exceeded.
    OutOfMemory,
    /// The process ended before it answered.
    Crashed(Crash),
    /// The answer is invalid.
    Protocol(String),
}

/// A time limit that was exceeded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeLimit {
    /// The CPU time limit.
    Cpu,
    /// The limit on time spent waiting for something other than a processor.
    Waiting,
    /// The wall time limit, on systems that don't report how a process uses its time.
    Wall,
}

/// How a process ended before it answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crash {
    /// Its stack overflowed.
    StackOverflow,
    /// It exited with this code.
    Exited(i32),
    /// It was ended by this signal.
    Signal(i32),
    /// It was killed from outside while using little memory. If the machine runs out of memory, the
    /// system may kill any process.
    Killed,
    /// It failed before the first question, so none of the submission's functions had been called
    /// yet.
    NotStarted,
}

impl Fault {
    /// Returns whether the machine, rather than the submission, may have caused the fault.
    pub fn is_doubtful(&self) -> bool {
        matches!(self, Fault::Crashed(Crash::Killed | Crash::NotStarted))
    }

    /// Converts the fault to a reason that can be compared with the signatures of known mistakes.
    pub fn no_answer_reason(&self) -> NoAnswerReason {
        match self {
            Fault::TimedOut(_) => NoAnswerReason::Time,
            Fault::OutOfMemory => NoAnswerReason::Memory,
            Fault::Crashed(Crash::StackOverflow) => NoAnswerReason::Stack,
            Fault::Crashed(
                Crash::Exited(_) | Crash::Signal(_) | Crash::Killed | Crash::NotStarted,
            )
            | Fault::Protocol(_) => NoAnswerReason::Other,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            // Leave out the limit, which depends on the machine's speed, so that the same
            // submission always gets the same report.
            Fault::TimedOut(TimeLimit::Cpu) => {
                f.write_str("stopped because it took too long: is there an infinite loop?")
            }
            Fault::TimedOut(TimeLimit::Waiting) => f.write_str(
                "stopped because it did nothing for a few seconds: is it waiting for something?",
            ),
            Fault::TimedOut(TimeLimit::Wall) => f.write_str(
                "stopped because it took too long: is there an infinite loop, or is it waiting for \
                 something?",
            ),
            Fault::OutOfMemory => f.write_str("out of memory: does something grow without limit?"),
            Fault::Crashed(Crash::StackOverflow) => {
                f.write_str("the stack overflowed: is there infinite recursion?")
            }
            Fault::Crashed(Crash::Exited(code)) => {
                write!(f, "the program exited with code {code} before it answered")
            }
            Fault::Crashed(Crash::Signal(signal)) => {
                write!(f, "the program was killed by signal {signal}")
            }
            Fault::Crashed(Crash::Killed) => f.write_str(
                "the system killed the program (signal 9) even while nothing else was running, but it \
                 didn't kill a small test program",
            ),
            Fault::Crashed(Crash::NotStarted) => f.write_str(
                "the program could not be started: keep `static` and `thread_local!` variables \
                 below 32 MiB in total, and allocate larger ones in a method, for example with \
                 `vec!`",
            ),
            Fault::Protocol(why) => write!(f, "the program sent an invalid answer: {why}"),
        }
    }
}
