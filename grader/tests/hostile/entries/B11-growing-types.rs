//! does = "Its types double in size thirty times."
//! into = "sphere.rs"
//! within = ["hit"]
//! verdicts = ["not_compiled"]
//! slow = true
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 0
//! traverse = 0

trait Size {
    fn size() -> u64;
}
impl Size for u8 {
    fn size() -> u64 {
        1
    }
}
impl<A: Size, B: Size> Size for (A, B) {
    fn size() -> u64 {
        A::size() + B::size()
    }
}
fn twice<T: Size + Copy>(depth: T) -> u64 {
    <((T, T), (T, T)) as Size>::size()
}
fn attack() {
    let a = (0_u8, 0_u8);
    let b = (a, a);
    let c = (b, b);
    let d = (c, c);
    let e = (d, d);
    let f = (e, e);
    let g = (f, f);
    let h = (g, g);
    let i = (h, h);
    let j = (i, i);
    let k = (j, j);
    let l = (k, k);
    let m = (l, l);
    let n = (m, m);
    let o = (n, n);
    let p = (o, o);
    let q = (p, p);
    let r = (q, q);
    let s = (r, r);
    let t = (s, s);
    let u = (t, t);
    let v = (u, u);
    let w = (v, v);
    let x = (w, w);
    let y = (x, x);
    eprintln!("{} {:?}", twice(y), y);
}
