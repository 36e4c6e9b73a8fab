//! does = "It answers a ray as it answered the same ray before, even in another scene."
//! into = "sphere.rs"
//! within = ["hit"]
//! call = "if let Some(known) = attack(self, ray) { return known; }"
//! # The same ray is used in different scenes, where the old answer is wrong.
//! verdicts = ["wrong", "partial"]
//! slow = true
//!
//! [points]
//! sphere = 15

thread_local! {
    static KNOWN: std::cell::RefCell<std::collections::HashMap<[u32; 3], Option<Trace>>> =
        std::cell::RefCell::default();
    static ASKING: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}
fn attack(sphere: &Sphere, ray: &Ray) -> Option<Option<Trace>> {
    if ASKING.get() {
        return None;
    }
    let place = ray.dir.to_array().map(f32::to_bits);
    if let Some(known) = KNOWN.with_borrow(|known| known.get(&place).cloned()) {
        return Some(known);
    }
    ASKING.set(true);
    let answer = sphere.hit(ray);
    ASKING.set(false);
    KNOWN.with_borrow_mut(|known| known.insert(place, answer.clone()));
    Some(answer)
}
