//! What is asked, what counts as right, and how an answer is compared with it.
//!
//! Nothing here knows of processes, compilers or reports; but for reading an exam's file, all of it is
//! pure. A package of its own because it is what a grader spends its time in: this is compiled to be
//! fast, and the rest of the grader to be compiled fast.
//!
//! Floors, from the ground up; each imports only from below:
//!
//! | floor | modules |
//! |---|---|
//! | seen in answers | [`picture`], [`recognise`] |
//! | comparing | [`judge`] |
//! | in words | [`describe`] |
//! | reading exams | [`exam_file`] |
//! | data | [`exam`], [`tells`], [`shown`], [`section`]; [`tame`] |

pub mod describe;
pub mod drawing_data;
pub mod exam;
pub mod exam_file;
pub mod judge;
pub mod picture;
pub mod recognise;
pub mod sanitize;
pub mod section;
pub mod signatures;
