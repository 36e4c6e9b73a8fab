//! The page of the real binary in a real browser: Chromium without a window, spoken to by its
//! DevTools protocol. Where there is none the tests say so and pass; with `CI` set it is required.

mod accessibility;
mod chromium;
mod devtools;
mod interaction;
mod pages;
mod rendering;
