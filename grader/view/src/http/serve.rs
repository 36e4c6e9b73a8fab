//! Accepts connections.

use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::request::{Request, RequestError};
use super::response::{Response, Status};

/// The maximum number of open connections that haven't made a trusted request. If there are more,
/// the oldest of them is closed, so that idle connections cannot keep the page from being served.
const MAX_UNTRUSTED: usize = 100;
/// The maximum number of trusted requests to answer at the same time. A browser opens at most six
/// connections to one server.
const MAX_TRUSTED: usize = 64;
/// The time limit for a complete request to arrive.
const READ_TIMEOUT: Duration = Duration::from_secs(10);
/// The time limit for a complete response to be read.
const WRITE_TIMEOUT: Duration = Duration::from_secs(30);

/// Answers requests.
pub trait Site: Send + Sync + 'static {
    /// Returns whether the request comes from the user.
    fn trusts(&self, request: &Request) -> bool;
    /// Answers a request.
    fn answer(&self, request: &Request) -> Response;
}

struct Server<S> {
    site: S,
    /// The connections that haven't made a trusted request, oldest first.
    untrusted: Mutex<BTreeMap<u64, Arc<TcpStream>>>,
    /// Cloned once for each trusted request being answered.
    trusted: Arc<()>,
}

/// Answers requests until the process ends. Each connection has its own thread, so that a request
/// that waits for updates doesn't delay others.
pub fn serve(listener: &TcpListener, site: impl Site) {
    let server = Arc::new(Server {
        site,
        untrusted: Mutex::default(),
        trusted: Arc::default(),
    });
    for (number, stream) in (0..).zip(listener.incoming()) {
        let Ok(stream) = stream else {
            // The peer has already disconnected, or the system is out of file descriptors.
            server.close_oldest();
            thread::sleep(Duration::from_millis(10));
            continue;
        };
        let stream = Arc::new(stream);
        if server.untrusted().len() >= MAX_UNTRUSTED {
            server.close_oldest();
        }
        server.untrusted().insert(number, Arc::clone(&stream));
        let of_thread = Arc::clone(&server);
        let started = thread::Builder::new()
            .name("connection".to_owned())
            .spawn(move || {
                // The peer may have closed the connection, which is fine.
                let _ = of_thread.handle(number, &stream);
                of_thread.untrusted().remove(&number);
            });
        if started.is_err() {
            server.untrusted().remove(&number);
        }
    }
}

impl<S: Site> Server<S> {
    fn untrusted(&self) -> MutexGuard<'_, BTreeMap<u64, Arc<TcpStream>>> {
        self.untrusted
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }

    /// Closes the oldest connection that hasn't made a trusted request. Its thread then ends.
    fn close_oldest(&self) {
        if let Some((_, stream)) = self.untrusted().pop_first() {
            let _ = stream.shutdown(Shutdown::Both);
        }
    }

    fn handle(&self, number: u64, stream: &TcpStream) -> io::Result<()> {
        stream.set_nodelay(true)?;
        let request = Request::read(&mut DeadlineStream::new(stream, READ_TIMEOUT));
        let mut slot = None;
        let response = match request {
            Ok(request) if self.site.trusts(&request) => {
                self.untrusted().remove(&number);
                let slot = slot.insert(Arc::clone(&self.trusted));
                if Arc::strong_count(slot) > MAX_TRUSTED + 1 {
                    Response::text(Status::UNAVAILABLE, "too many connections")
                } else {
                    self.site.answer(&request)
                }
            }
            Ok(request) => self.site.answer(&request),
            Err(RequestError::Io(error)) => return Err(error),
            Err(error) => Response::text(Status::BAD_REQUEST, &error.to_string()),
        };
        response.write(&mut DeadlineStream::new(stream, WRITE_TIMEOUT))
    }
}

/// A connection that can be used until a deadline. A socket's timeouts apply to each read or write,
/// so a peer that sends or reads one byte at a time would never exceed them.
struct DeadlineStream<'a> {
    stream: &'a TcpStream,
    deadline: Instant,
}

impl<'a> DeadlineStream<'a> {
    fn new(stream: &'a TcpStream, timeout: Duration) -> Self {
        DeadlineStream {
            stream,
            deadline: Instant::now() + timeout,
        }
    }

    fn left(&self) -> io::Result<Option<Duration>> {
        let left = self.deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            return Err(io::ErrorKind::TimedOut.into());
        }
        Ok(Some(left))
    }
}

impl Read for DeadlineStream<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        self.stream.set_read_timeout(self.left()?)?;
        self.stream.read(buffer)
    }
}

impl Write for DeadlineStream<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stream.set_write_timeout(self.left()?)?;
        self.stream.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns both ends of a connection.
    fn connection() -> (TcpStream, TcpStream) {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let client = TcpStream::connect(listener.local_addr().unwrap()).unwrap();
        (client, listener.accept().unwrap().0)
    }

    #[test]
    fn a_request_of_one_byte_at_a_time_ends_at_the_deadline() {
        let (mut client, server) = connection();
        thread::spawn(move || {
            while client.write_all(b"G").is_ok() {
                thread::sleep(Duration::from_millis(5));
            }
        });
        let started_at = Instant::now();
        let mut timed = DeadlineStream::new(&server, Duration::from_millis(100));
        assert!(matches!(
            Request::read(&mut timed),
            Err(RequestError::Io(_))
        ));
        assert!(started_at.elapsed() < Duration::from_secs(5));
    }

    #[test]
    fn a_response_that_nobody_reads_ends_at_the_deadline() {
        let (client, server) = connection();
        let response = Response::new(Status::OK, "text/plain", vec![0; 64 << 20]);
        let started_at = Instant::now();
        let mut timed = DeadlineStream::new(&server, Duration::from_millis(100));
        assert!(response.write(&mut timed).is_err());
        assert!(started_at.elapsed() < Duration::from_secs(5));
        drop(client);
    }
}
