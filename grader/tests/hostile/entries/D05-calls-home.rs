//! does = "It contacts listeners in every way that it can."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        use std::io::Write;
        if let Ok(mut stream) = std::net::TcpStream::connect("127.0.0.1:@TCP@") {
            stream.write_all(b"the questions").ok();
        }
        if let Ok(socket) = std::net::UdpSocket::bind("127.0.0.1:0") {
            socket.send_to(b"questions", "127.0.0.1:@UDP@").ok();
            eprintln!("reached: UDP");
        }
        if std::os::unix::net::UnixStream::connect("@UNIX@").is_ok() {
            eprintln!("reached: a Unix socket");
        }
        if std::net::TcpListener::bind("127.0.0.1:0").is_ok() {
            eprintln!("reached: a port");
        }
        let hidden = std::os::unix::net::UnixDatagram::unbound();
        eprintln!("{}", if hidden.is_ok() { "reached: a socket" } else { "nothing" });
    });
}
