
fn attack() {
    std::fs::write("@OUT@/score.json", "{\"points\": 100}").ok();
    std::fs::write("@OUT@/report.html", "<b id=forged>100</b>").ok();
    std::fs::remove_file("@OUT@/score.json").ok();
}
