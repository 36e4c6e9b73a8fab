//! A build for the tests of other modules.

use std::time::Duration;

use super::*;
use crate::build::linker::SystemLinker;
use crate::handed_out::RAYS;

impl Build {
    /// Returns a build in `folder` without any programs, because the files in `not_compiled` didn't
    /// compile.
    pub fn without_programs(
        folder: &Path,
        not_compiled: BTreeMap<&'static str, NotCompiled>,
    ) -> Self {
        let toolchain = Toolchain {
            cargo: PathBuf::new(),
            rustc: PathBuf::new(),
            linker: SystemLinker::default(),
        };
        let dependencies = Dependencies {
            externs: BTreeMap::new(),
            folder: PathBuf::new(),
        };
        Build {
            handed_out: &RAYS,
            probe: None,
            methods: BTreeMap::new(),
            warnings: Vec::new(),
            not_compiled,
            took: Duration::ZERO,
            interrupt: Interrupt::default(),
            substitutions: Vec::new(),
            unstartable: Mutex::default(),
            rustc: Rustc::new(toolchain, dependencies),
            build_dir: BuildDir::new_in(folder).unwrap(),
        }
    }
}
