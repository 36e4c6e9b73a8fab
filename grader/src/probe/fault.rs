//! What can come instead of an answer.

use std::fmt;
use std::time::Duration;

use crate::signatures::NoAnswerReason;

/// Why there is no answer. Every one costs the item, and the probe.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The item's time is over.
    TimedOut(TimeLimit),
    /// Memory ran out.
    OutOfMemory,
    /// The process ended.
    Crashed(Crash),
    /// What came is no answer to what was asked.
    Protocol(String),
}

/// Which time was over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeLimit {
    /// So much CPU time was used.
    Cpu(Duration),
    /// It waited for so long without using its CPU time.
    Wall(Duration),
}

/// How a process ended before it had answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crash {
    /// It recursed until its stack was full.
    StackOverflow,
    /// It left by itself.
    Exited(i32),
    /// The system ended it.
    Signal(i32),
    /// Somebody ended it who is neither itself nor its limits, and it held little memory: where
    /// memory runs out, the system ends whom it likes.
    Killed,
}

impl Fault {
    /// As much of it as tells mistakes apart.
    pub fn no_answer_reason(&self) -> NoAnswerReason {
        match self {
            Fault::TimedOut(_) => NoAnswerReason::Time,
            Fault::OutOfMemory => NoAnswerReason::Memory,
            Fault::Crashed(Crash::StackOverflow) => NoAnswerReason::Stack,
            Fault::Crashed(Crash::Exited(_) | Crash::Signal(_) | Crash::Killed)
            | Fault::Protocol(_) => NoAnswerReason::Other,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Fault::TimedOut(TimeLimit::Cpu(limit)) => write!(
                f,
                "stopped after {} s of computing: an endless loop?",
                limit.as_secs_f64()
            ),
            Fault::TimedOut(TimeLimit::Wall(limit)) => write!(
                f,
                "stopped after {} s: is it waiting for something?",
                limit.as_secs_f64()
            ),
            Fault::OutOfMemory => f.write_str("out of memory: does something grow without end?"),
            Fault::Crashed(Crash::StackOverflow) => {
                f.write_str("the stack overflowed: recursion without end?")
            }
            Fault::Crashed(Crash::Exited(code)) => write!(
                f,
                "the program ended (exit code {code}) before it had answered"
            ),
            Fault::Crashed(Crash::Signal(signal)) => {
                write!(f, "the program was ended by signal {signal}")
            }
            Fault::Crashed(Crash::Killed) => f.write_str(
                "the system has ended the program (signal 9), which held little memory: give this \
                 machine more, or grade fewer at once",
            ),
            Fault::Protocol(why) => write!(f, "what came back is no answer: {why}"),
        }
    }
}
