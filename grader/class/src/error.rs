//! Errors that stop the grading of a class, and their exit codes.

use std::path::PathBuf;

use grader::error::Error as GraderError;
use grader::policy::PolicyError;
use grader::select_isolation::IsolationError;

use crate::hand_back::HandBackError;
use crate::input_error::ClassInputError;
use crate::list_memory::ListMemoryError;
use crate::lists::UnlistedClassError;
use crate::manual::ManualPointsError;
use crate::shard::Shard;
use crate::similarity::SimilarityError;
use crate::store::StoreError;
use crate::table::TableError;

/// An error that stops the grading of a class.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The input cannot be used.
    #[error(transparent)]
    Input(#[from] ClassInputError),
    /// The roster or a gradebook cannot be used.
    #[error(transparent)]
    List(#[from] TableError),
    /// A list cannot be read, or the one of an earlier run cannot be used.
    #[error(transparent)]
    ListMemory(#[from] ListMemoryError),
    /// Most submissions match nobody on the lists.
    #[error(transparent)]
    Unlisted(#[from] UnlistedClassError),
    /// The points by hand cannot be used.
    #[error(transparent)]
    ManualPoints(#[from] ManualPointsError),
    /// The output folder cannot be used.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The archive to hand back cannot be made.
    #[error(transparent)]
    HandBack(#[from] HandBackError),
    /// The input for a similarity checker cannot be written.
    #[error(transparent)]
    Similarity(#[from] SimilarityError),
    /// The submissions cannot be isolated from the machine.
    #[error("{0}; if you trust the submissions, use --isolation none")]
    Isolation(IsolationError),
    /// The grader cannot be set up, because of the exam, the compiler or the dependencies.
    #[error(transparent)]
    Grader(GraderError),
    /// The policy cannot be used.
    #[error(transparent)]
    Policy(#[from] PolicyError),
    /// The output folder has scores that depend on other settings.
    #[error(
        "{} has scores that cannot be compared with new ones: {} changed; use --regrade to grade \
        everything again and list the changes, or name a new folder",
        out.display(), differences.join(", ")
    )]
    SettingsChanged {
        /// The output folder.
        out: PathBuf,
        /// The settings that differ.
        differences: Vec<&'static str>,
    },
    /// The output folder has the results of another part of the class.
    #[error(
        "{} has the results of {was}, and not of {now}: name another folder, or remove this one",
        out.display()
    )]
    OtherShard {
        /// The output folder.
        out: PathBuf,
        /// The part in the folder.
        was: String,
        /// The part to grade.
        now: String,
    },
    /// The results would be written among the submissions.
    #[error(
        "{} is in {}: the results would be taken for submissions; choose another folder for --out",
        out.display(),
        input.display()
    )]
    OutInInput {
        /// The output folder.
        out: PathBuf,
        /// The input folder.
        input: PathBuf,
    },
    /// There are no scores to regrade.
    #[error("{} holds no scores yet: leave out --regrade", .0.display())]
    NothingToRegrade(PathBuf),
    /// A folder is not the output folder of a shard.
    #[error("{} contains no results of `cargo class --shard`", .0.display())]
    NotAShard(PathBuf),
    /// A shard was not graded completely.
    #[error("{} is not finished: run its `cargo class --shard` again", .0.display())]
    UnfinishedShard(PathBuf),
    /// Two shards were graded with different settings.
    #[error(
        "{} and {} cannot be merged: they differ in {}",
        one.display(), other.display(), differences.join(", ")
    )]
    IncompatibleShards {
        /// The output folder of one shard.
        one: PathBuf,
        /// The output folder of the other shard.
        other: PathBuf,
        /// The settings that differ.
        differences: Vec<&'static str>,
    },
    /// Some shards were not given on the command line.
    #[error(
        "results are missing for {}: name the output folders of all parts, or the merged grades \
        would lack submissions",
        join_shards(.0)
    )]
    MissingShards(Vec<Shard>),
    /// Two shards are parts of different lists of submissions.
    #[error(
        "{} and {} cannot be merged, or somebody could be missing: submissions were added or removed \
         between them; run each `cargo class --shard` again, which keeps what is graded",
        one.display(), other.display()
    )]
    DifferentClasses {
        /// The output folder of one shard.
        one: PathBuf,
        /// The output folder of the other shard.
        other: PathBuf,
    },
    /// Two shards contain the same entry.
    #[error(
        "{id} is in {} and in {}: were both given the same --shard?", one.display(), other.display()
    )]
    DuplicateEntry {
        /// The entry's id.
        id: String,
        /// The output folder of one shard.
        one: PathBuf,
        /// The output folder of the other shard.
        other: PathBuf,
    },
    /// The merged results would be written into the results of a shard.
    #[error(
        "{} is, or is in, the results of the shard {}: choose another folder for --out",
        out.display(),
        shard.display()
    )]
    MergeIntoShard {
        /// The output folder of the merge.
        out: PathBuf,
        /// The output folder of the shard.
        shard: PathBuf,
    },
}

impl Error {
    /// Returns 2 if the user can fix the error, and 3 if the grader or the machine is at fault.
    pub fn exit_code(&self) -> u8 {
        match self {
            Error::Input(_)
            | Error::List(_)
            | Error::Unlisted(_)
            | Error::ManualPoints(_)
            | Error::ListMemory(_)
            | Error::Similarity(SimilarityError::NotEmpty(_) | SimilarityError::Overlap { .. })
            | Error::Policy(_)
            | Error::SettingsChanged { .. }
            | Error::NothingToRegrade(_)
            | Error::OtherShard { .. }
            | Error::OutInInput { .. }
            | Error::NotAShard(_)
            | Error::UnfinishedShard(_)
            | Error::IncompatibleShards { .. }
            | Error::MissingShards(_)
            | Error::DifferentClasses { .. }
            | Error::DuplicateEntry { .. }
            | Error::MergeIntoShard { .. } => 2,
            Error::Store(_)
            | Error::Similarity(SimilarityError::File(_))
            | Error::HandBack(_)
            | Error::Isolation(_) => 3,
            Error::Grader(error) => error.exit_code(),
        }
    }
}

fn join_shards(shards: &[Shard]) -> String {
    let names: Vec<String> = shards.iter().map(Shard::to_string).collect();
    names.join(", ")
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
            | GraderError::Reset(_)
            | GraderError::HandIn(_)
            | GraderError::RequiredPoints { .. }
            | GraderError::Workspace(_)
            | GraderError::Build(_)
            | GraderError::File(_)
            | GraderError::Probe(_) => Error::Grader(error),
        }
    }
}
