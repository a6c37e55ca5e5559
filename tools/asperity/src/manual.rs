//! `asperity completions` and `asperity man`: shell completions and the manual page.

use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;

use crate::cli::Cli;
use crate::failure::Result;
use crate::progress;

/// Prints the completions of a shell.
pub(crate) fn completions(shell: Shell) -> Result<()> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "asperity", &mut script);
    print(script)
}

/// Prints the manual page, with a section for each command.
pub(crate) fn man() -> Result<()> {
    let mut command = Cli::command();
    command.build();
    let mut page = Vec::new();
    let man = Man::new(command.clone());
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_options_section(&mut page)?;
    for command in command.get_subcommands().filter(|command| command.get_name() != "help") {
        let mut section = Vec::new();
        let man = Man::new(command.clone());
        man.render_synopsis_section(&mut section)?;
        man.render_description_section(&mut section)?;
        man.render_options_section(&mut section)?;
        man.render_extra_section(&mut section)?;
        // Sections of the page become subsections of the command.
        let section = String::from_utf8_lossy(&section)
            .replace("\n.SH EXTRA", "\n.SS EXAMPLES")
            .replace("\n.SH ", "\n.SS ");
        let section = section.strip_prefix(".SH ").map_or(section.clone(), |rest| format!(".SS {rest}"));
        page.extend(format!(".SH {}\n{section}", command.get_name().to_uppercase()).into_bytes());
    }
    print(page)
}

fn print(text: Vec<u8>) -> Result<()> {
    Ok(progress::print(&String::from_utf8(text)?)?)
}
