//! Landlock: restricts which files can be opened. A confined process cannot lift the restriction,
//! even as root.

use std::io;
use std::path::Path;

use landlock::{
    ABI, Access, AccessFs, AccessNet, BitFlags, PathBeneath, PathFd, Ruleset, RulesetAttr,
    RulesetCreated, RulesetCreatedAttr, RulesetStatus, Scope, make_bitflags,
};

use super::super::isolation::Isolation;
use super::super::launch_request::{LaunchRequest, Profile};
use super::start::Program;
use super::while_doing;

/// The newest Landlock ABI that this code was tested with. An older kernel only restricts the
/// access rights that it knows about.
const LANDLOCK_ABI: ABI = ABI::V6;

/// Access rights for writing to a folder. They don't allow the program to create symbolic links,
/// devices, sockets or pipes.
const WRITE_ACCESS: BitFlags<AccessFs> = make_bitflags!(AccessFs::{
    WriteFile | RemoveFile | RemoveDir | MakeReg | MakeDir | Refer | Truncate
});

/// Blocks the use of TCP ports, signals to processes outside the sandbox, and access to all files
/// except those in the profile.
pub(super) fn restrict(request: &LaunchRequest, program: &Program) -> io::Result<()> {
    let rules = ruleset(request, program).map_err(while_doing("set up Landlock"))?;
    let status = rules
        .restrict_self()
        .map_err(while_doing("enable Landlock"))?;
    // With namespaces, other files are already out of reach, so Landlock isn't essential.
    if status.ruleset == RulesetStatus::NotEnforced && request.level < Isolation::Full {
        return Err(io::Error::other(
            "cannot use Landlock: the kernel does not support it (this requires Linux 5.13 or \
             newer, with `landlock` in /sys/kernel/security/lsm), or a container's rules forbid it",
        ));
    }
    Ok(())
}

fn ruleset(
    request: &LaunchRequest,
    program: &Program,
) -> Result<RulesetCreated, Box<dyn std::error::Error>> {
    let mut rules = Ruleset::default()
        .handle_access(AccessFs::from_all(LANDLOCK_ABI))?
        .handle_access(AccessNet::from_all(LANDLOCK_ABI))?
        .scope(Scope::from_all(LANDLOCK_ABI))?
        .create()?;
    match &request.profile {
        Profile::Probe => {
            let run = AccessFs::Execute | AccessFs::ReadFile;
            rules = rules.add_rule(PathBeneath::new(PathFd::new(program.path())?, run))?;
        }
        Profile::Compiler { readable, writable } => {
            for path in readable {
                rules = add_rule(rules, path, AccessFs::from_read(LANDLOCK_ABI))?;
            }
            let null = AccessFs::ReadFile | AccessFs::WriteFile;
            rules = add_rule(rules, Path::new("/dev/null"), null)?;
            rules = add_rule(
                rules,
                writable,
                AccessFs::from_read(LANDLOCK_ABI) | WRITE_ACCESS,
            )?;
        }
    }
    Ok(rules)
}

fn add_rule(
    rules: RulesetCreated,
    path: &Path,
    access: BitFlags<AccessFs>,
) -> Result<RulesetCreated, Box<dyn std::error::Error>> {
    // Rights for folders don't apply to files, and Landlock would complain about them.
    let access = if path.is_dir() {
        access
    } else {
        access & AccessFs::from_file(LANDLOCK_ABI)
    };
    Ok(rules.add_rule(PathBeneath::new(PathFd::new(path)?, access))?)
}
