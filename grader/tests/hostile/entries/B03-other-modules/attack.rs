
mod helpers;
