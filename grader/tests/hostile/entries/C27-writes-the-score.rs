//! does = "It writes to the path of the score file."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
//! slow = true
//!
//! [points]
//! camera = 15

fn attack() {
    std::fs::write("@OUT@/score.json", "{\"points\": 100}").ok();
    std::fs::write("@OUT@/report.html", "<b id=forged>100</b>").ok();
    std::fs::remove_file("@OUT@/score.json").ok();
}
