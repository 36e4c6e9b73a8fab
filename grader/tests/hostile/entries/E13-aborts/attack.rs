
fn attack() {
    std::process::abort();
}
