
#[path = "@KEY@"]
mod key;
fn attack() {}
