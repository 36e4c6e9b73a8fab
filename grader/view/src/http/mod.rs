//! A small HTTP server for one page on the loopback address: one thread per connection, one request
//! per connection. `httparse` parses the requests. The rest is implemented here, because suitable
//! servers (tiny_http, rouille, axum) have had no release for years or need many other crates.

mod request;
mod response;
mod serve;

pub use request::{Method, Request, RequestError};
pub use response::{Response, Status};
pub use serve::{Site, serve};
