//! What can go wrong with a class as a whole, and whose fault it is.

use std::path::PathBuf;

use grader::error::Error as GraderError;
use grader::policy::PolicyError;
use grader::select_isolation::IsolationError;

use crate::input_error::ClassInputError;
use crate::shard::Shard;
use crate::store::StoreError;
use crate::table::TableError;

/// Why there is no class.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The input.
    #[error(transparent)]
    Input(#[from] ClassInputError),
    /// A list of the class.
    #[error(transparent)]
    List(#[from] TableError),
    /// The output folder.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Submissions can not be kept apart from the machine.
    #[error("{0}; for code that you would run anyway, say --isolation none")]
    Isolation(IsolationError),
    /// The exam, the compiler, or what it needs.
    #[error(transparent)]
    Grader(GraderError),
    /// The policy.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// The command line that `cargo grade` would have.
    #[error("{0}")]
    Arguments(clap::Error),
    /// The results of another run.
    #[error(
        "{} holds scores that are not comparable: {} changed; --regrade grades all again and says \
         what changes, or name a new folder",
        out.display(), differences.join(", ")
    )]
    SettingsChanged {
        /// The output folder.
        out: PathBuf,
        /// What is not the same.
        differences: Vec<&'static str>,
    },
    /// There is nothing to regrade.
    #[error("{} holds no scores yet: leave out --regrade", .0.display())]
    NothingToRegrade(PathBuf),
    /// A folder that is no shard.
    #[error("{} holds no results of `cargo class --shard`", .0.display())]
    NotAShard(PathBuf),
    /// A shard that was not graded to its end.
    #[error("{} is not finished: run its `cargo class --shard` again", .0.display())]
    UnfinishedShard(PathBuf),
    /// Shards that were graded differently.
    #[error(
        "{} and {} do not belong together: {} differ", one.display(), other.display(), differences.join(", ")
    )]
    IncompatibleShards {
        /// A shard.
        one: PathBuf,
        /// Another.
        other: PathBuf,
        /// What is not the same.
        differences: Vec<&'static str>,
    },
    /// Some shards were not named.
    #[error(
        "part {} is not among them, and who is in it would be lost: name all folders",
        join_shards(.0)
    )]
    MissingShards(Vec<Shard>),
    /// Shards whose points count for different things.
    #[error(
        "{} and {} were graded with different policies: say with --policy which one counts",
        one.display(), other.display()
    )]
    DifferentPolicies {
        /// A shard.
        one: PathBuf,
        /// Another.
        other: PathBuf,
    },
    /// The same entry in two shards.
    #[error("{id} is in {} and in {}: were both given the same --shard?", one.display(), other.display())]
    DuplicateEntry {
        /// The entry's id.
        id: String,
        /// A shard.
        one: PathBuf,
        /// Another.
        other: PathBuf,
    },
}

impl Error {
    /// 2 where whoever typed the command can mend it, 3 where it is our fault or the machine's.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Input(_)
            | Error::List(_)
            | Error::Policy(_)
            | Error::Arguments(_)
            | Error::SettingsChanged { .. }
            | Error::NothingToRegrade(_)
            | Error::NotAShard(_)
            | Error::UnfinishedShard(_)
            | Error::IncompatibleShards { .. }
            | Error::MissingShards(_)
            | Error::DifferentPolicies { .. }
            | Error::DuplicateEntry { .. } => 2,
            Error::Store(_) | Error::Isolation(_) => 3,
            Error::Grader(error) => error.exit_code(),
        }
    }
}

fn join_shards(shards: &[Shard]) -> String {
    let words: Vec<String> = shards.iter().map(Shard::to_string).collect();
    words.join(", ")
}

impl From<GraderError> for Error {
    fn from(error: GraderError) -> Self {
        match error {
            GraderError::Isolation(error) => Error::Isolation(error),
            GraderError::Submission(_)
            | GraderError::Exam(_)
            | GraderError::Policy(_)
            | GraderError::SubmissionTime(_)
            | GraderError::Package(_)
            | GraderError::Output(_)
            | GraderError::Replay(_)
            | GraderError::Workspace(_)
            | GraderError::Build(_)
            | GraderError::Report { .. }
            | GraderError::Probe(_) => Error::Grader(error),
        }
    }
}
