//! Computes trigonometric functions and powers, with the same results on every machine. With the
//! standard library's functions, the last bit of a result can differ between systems, so pictures
//! would differ.

/// Returns the angle in `[0, π]` whose cosine is `x`, in radians.
pub fn acos(x: f32) -> f32 {
    libm::acosf(x)
}

/// Returns the angle in `(-π, π]` from the x-axis to `(x, y)`, in radians.
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// Returns the sine and the cosine of an angle in radians.
pub fn sin_cos(angle: f32) -> (f32, f32) {
    libm::sincosf(angle)
}

/// Returns the tangent of an angle in radians.
pub fn tan(angle: f32) -> f32 {
    libm::tanf(angle)
}

/// Returns `base` to the power of `exponent`.
pub fn pow(base: f32, exponent: f32) -> f32 {
    libm::powf(base, exponent)
}
