//! The inputs of a command, besides the submission and the policy, as people write them.

pub mod exam_source;
pub mod nearest_name;
pub mod question_ref;
pub mod task_selection;
