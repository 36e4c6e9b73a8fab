
#![feature(asm_experimental_arch)]
