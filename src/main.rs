//! The program `anel`; `anel --help` lists its commands.

use std::process::ExitCode;

fn main() -> ExitCode {
    anel::cli::main()
}
