//! Tests of the report page in headless Chromium, controlled over the DevTools protocol. If
//! Chromium isn't installed, the tests print a notice and pass, or fail if `CI` is set.

mod accessibility;
mod interaction;
mod pages;
mod rendering;
