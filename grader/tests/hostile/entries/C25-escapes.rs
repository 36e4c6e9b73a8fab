//! does = "It prints escapes, markup, formulas, and a line of a megabyte."
//! into = "camera.rs"
//! within = ["sample_ray"]
//!
//! [also.light]
//! into = "path.rs"
//! within = ["radiance"]

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        eprintln!("\u{1b}[2J\u{1b}]0;100 points\u{7}\u{202e}");
        eprintln!("<b id=forged>100</b></script><script>alert(1)</script>");
        eprintln!("=HYPERLINK(\"http://localhost\")\n| a | b |\n::set-output name=points::100");
        eprintln!("{}", "x".repeat(1 << 20));
    });
}
