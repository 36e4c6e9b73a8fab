
pub const DEEP: u32 = @{200000x(}1@{200000x)};
