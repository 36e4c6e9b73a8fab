//! Accepts connections.

use std::io;
use std::net::{TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Duration;

use super::request::{Request, RequestError};
use super::response::{Response, Status};

/// The maximum number of open connections. A browser opens at most six to one server.
const MAX_CONNECTIONS: usize = 64;
/// The time in which a request must arrive.
const READ_TIMEOUT: Duration = Duration::from_secs(10);
/// The time in which a response must be taken.
const WRITE_TIMEOUT: Duration = Duration::from_secs(30);

/// Answers requests until the process ends. Each connection has its own thread, so that a request
/// that waits for news delays no other.
pub fn serve(
    listener: &TcpListener,
    answer: impl Fn(&Request) -> Response + Send + Sync + 'static,
) {
    let answer = Arc::new(answer);
    let open = Arc::new(AtomicUsize::new(0));
    for stream in listener.incoming() {
        let Ok(stream) = stream else {
            // The system is out of file descriptors, or the other side has ended already.
            thread::sleep(Duration::from_millis(50));
            continue;
        };
        let (answer, counter) = (Arc::clone(&answer), Arc::clone(&open));
        counter.fetch_add(1, Ordering::SeqCst);
        let is_busy = open.load(Ordering::SeqCst) > MAX_CONNECTIONS;
        let started = thread::Builder::new()
            .name("connection".to_owned())
            .spawn(move || {
                // The other side may have ended the connection, which is its right.
                let _ = if is_busy {
                    let busy = Response::text(Status::Unavailable, "too many connections");
                    busy.write(&mut &stream)
                } else {
                    handle(&stream, &*answer)
                };
                counter.fetch_sub(1, Ordering::SeqCst);
            });
        if started.is_err() {
            open.fetch_sub(1, Ordering::SeqCst);
        }
    }
}

fn handle(stream: &TcpStream, answer: &dyn Fn(&Request) -> Response) -> io::Result<()> {
    stream.set_read_timeout(Some(READ_TIMEOUT))?;
    stream.set_write_timeout(Some(WRITE_TIMEOUT))?;
    stream.set_nodelay(true)?;
    let response = match Request::read(&mut &*stream) {
        Ok(request) => answer(&request),
        Err(RequestError::Io(error)) => return Err(error),
        Err(error) => Response::text(Status::BadRequest, &error.to_string()),
    };
    response.write(&mut &*stream)
}
