
extern crate grader;
extern crate parts;
extern crate reference;
