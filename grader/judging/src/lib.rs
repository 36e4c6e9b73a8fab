//! Exams, answer keys, and the comparison of answers with them.
//!
//! Everything here is pure: this crate knows nothing about files, processes, compilers or reports.
//! It is a separate package so that it can be compiled with optimisations, because grading spends
//! most of its time here. The rest of the grader is built for fast compilation.
//!
//! These are the layers, from top to bottom. A module imports only from layers below its own:
//!
//! | layer | modules |
//! |---|---|
//! | analysis of answers | [`picture`], [`recognise`], [`observe`] |
//! | exam files | [`exam_file`] |
//! | comparison | [`judge`] |
//! | text | [`describe`] |
//! | types of fields | `types` |
//! | data | [`exam`], [`assignment`], [`signatures`], [`drawing_data`], [`scene`], [`section`], [`symptom`]; [`content_hash`], [`sanitize`] |

pub mod assignment;
pub mod content_hash;
pub mod describe;
pub mod drawing_data;
pub mod exam;
pub mod exam_file;
pub mod judge;
pub mod observe;
pub mod picture;
pub mod recognise;
pub mod sanitize;
pub mod scene;
pub mod section;
pub mod signatures;
pub mod symptom;
mod types;

#[cfg(test)]
mod tests;
