//! How an example ends: well, or with its error told on the error stream.

use std::fmt::Display;
use std::process::ExitCode;

/// What an example does, or why it could not.
pub type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// The exit code of what was done; an error is told.
pub fn exit_code<E: Display>(done: Result<(), E>) -> ExitCode {
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
