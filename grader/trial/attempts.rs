//! A program that runs in the sandbox in place of a submission. It attempts everything submissions
//! must not do and prints a line for each attempt that succeeds. Its standard input contains the
//! path of a file that every user may read.

use std::collections::HashMap;
use std::fs;
use std::net::{TcpListener, UdpSocket};
use std::os::unix::net::UnixDatagram;
use std::process::Command;
use std::thread;

fn main() {
    let mut path = String::new();
    std::io::stdin().read_line(&mut path).expect("questions can be read");
    let path = path.trim_end();
    let beside = format!("{path}.written");

    // Everything that a correct submission does must work, or the attempts below prove nothing.
    let counted = thread::spawn(|| HashMap::from([("threads", 1)])).join();
    assert_eq!(counted.expect("threads run")["threads"], 1);

    let attempts = [
        ("read a file", fs::read(path).is_ok()),
        ("write a file", fs::write(beside, "x").is_ok()),
        ("list a folder", fs::read_dir("/").is_ok()),
        ("look at other processes", fs::read("/proc/1/cmdline").is_ok()),
        ("open a TCP socket", TcpListener::bind("127.0.0.1:0").is_ok()),
        ("open a UDP socket", UdpSocket::bind("127.0.0.1:0").is_ok()),
        ("open a Unix socket", UnixDatagram::unbound().is_ok()),
        ("start a program", Command::new("/proc/self/exe").spawn().is_ok()),
    ];
    for (what, succeeded) in attempts {
        if succeeded {
            println!("{what}");
        }
    }
    println!("end");
}
