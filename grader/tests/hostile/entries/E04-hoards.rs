//! does = "It allocates memory until there is none left."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["out_of_memory"]
//! wall = 180
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    let mut hoard = Vec::new();
    loop {
        hoard.push(vec![1_u8; 1 << 20]);
    }
}
