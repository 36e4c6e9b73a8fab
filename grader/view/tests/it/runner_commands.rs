//! A CI system executes commands in a log. No name may become one.

use grader::printing::without_commands;

use crate::harness::view;

#[test]
fn no_name_in_an_error_is_a_command_in_a_log() {
    let name = "::error::a ##[set-env name=a]b";
    for arguments in [
        &[name][..],
        &["--submission", name],
        &["--item", name],
        &["--size", name],
    ] {
        let output = view().args(arguments).output().unwrap();
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(without_commands(&error), error, "{arguments:?}");
        assert!(error.contains("set-env"), "{arguments:?}: {error}");
    }
}
