//! does = "It is correct, and prints a line for each ray."
//! into = "camera.rs"
//! within = ["sample_ray"]

fn attack() {
    println!("here is another ray");
}
