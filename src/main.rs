//! The program: see `anel --help`.

use std::process::ExitCode;

fn main() -> ExitCode {
    anel::cli::main()
}
