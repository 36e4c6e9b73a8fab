//! Shows in a browser what a submission's code does: the picture while it is drawn, the tree, and
//! the tests that the submission's traversal makes for one ray.
//!
//! The submission's files are compiled as for grading, but with the crate `view_probe` instead of
//! the grader's probe. The crate `view` starts the programs, keeps the page's state and serves the
//! page on the loopback address.
//!
//! Layers, from top to bottom. A module imports only from layers below its own:
//!
//! | layer | modules |
//! |---|---|
//! | the command | [`run`] |
//! | its parts | [`cli`], [`browser`] |
//! | the page | [`routes`], with the files in `page` |
//! | access control | [`access`] |
//! | threads | [`workers`], [`watcher`], [`composer`] |
//! | the state, shared by the threads | [`shared_session`] |
//! | the state | [`session`] |
//! | questions as scenes | [`exam_question`] |
//! | scenes | [`subject`] |
//! | running programs | [`probe`] |
//! | builds | [`program`], [`source_links`] |
//! | changes to a submission's source | [`recording`] |
//! | pure parts | [`model`]: camera, order of drawing, tree, explanations; [`sweep_costs`] |
//! | the network, errors | [`http`], [`error`] |

pub mod access;
pub mod browser;
pub mod cli;
pub mod composer;
pub mod error;
pub mod exam_question;
pub mod http;
pub mod model;
pub mod probe;
pub mod program;
pub mod recording;
pub mod routes;
pub mod run;
pub mod session;
pub mod shared_session;
pub mod source_links;
pub mod subject;
pub mod sweep_costs;
pub mod watcher;
pub mod workers;
