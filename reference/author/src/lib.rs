//! Writes all that is generated: the starter, the exams, the scenes' meshes, what students get.
//!
//! It does not know the reference's code: what counts as right comes from the definitions, in
//! [`oracle`], in double precision. That both agree is found out by grading the reference.

pub mod bundle;
pub mod cli;
pub mod drawing_data;
pub mod exams;
pub mod generated_file;
pub mod handout;
pub mod hints;
pub mod items;
pub mod oracle;
pub mod package;
pub mod proof;
pub mod recording;
pub mod scenes;
pub mod seed;
pub mod starter;
pub mod tree;
