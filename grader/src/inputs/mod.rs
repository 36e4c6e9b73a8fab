//! The inputs that users pass to a command, except the submission and the policy.

pub mod exam_source;
pub mod nearest_name;
pub mod question_ref;
pub mod task_selection;
