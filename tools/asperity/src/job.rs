//! Job templates in the Open Job Description format, which render farms accept. A job has steps.
//! Each step has one task per number of a range, and every task is one call of this program.

use std::path::Path;

use serde_json::{Value, json};

use crate::failure::{Failure, Result};
use crate::output::Output;

/// Version of the format.
const VERSION: &str = "jobtemplate-2023-09";

/// A step of a job: one call, or one call per number of a range.
pub(crate) struct Step {
    pub(crate) name: &'static str,
    /// Name and range of the task parameter, e.g. `1-24`. Arguments refer to the parameter with
    /// [`number`].
    pub(crate) tasks: Option<(&'static str, String)>,
    pub(crate) arguments: Vec<String>,
    /// The step that must finish first.
    pub(crate) after: Option<&'static str>,
}

/// Returns the reference to a task parameter in the arguments of a step.
pub(crate) fn number(parameter: &str) -> String {
    format!("{{{{Task.Param.{parameter}}}}}")
}

/// Writes the job template as YAML or JSON, chosen by the file extension. The only parameter is the
/// path of the program.
pub(crate) fn write(file: &Path, name: &str, program: &Path, steps: &[Step]) -> Result<String> {
    let place = std::path::absolute(file)?;
    let (Some(folder), Some(of)) = (place.parent(), place.file_name()) else {
        return Err(format!("job `{}`: is a directory (expected a file)", file.display()).into());
    };
    refuse_braces(steps)?;
    let template = template(name, program, steps);
    let text = match place.extension().and_then(|ending| ending.to_str()) {
        Some("yaml" | "yml") => yaml(&template),
        Some("json") => serde_json::to_string_pretty(&template)? + "\n",
        _ => {
            return Err(format!(
                "job `{}`: unsupported file extension (expected .yaml or .json)",
                file.display()
            )
            .into());
        }
    };
    let output = Output::new(folder)?;
    output.write(&of.to_string_lossy(), text.as_bytes())?;
    Ok(output.place(&of.to_string_lossy()))
}

/// Returns an error for arguments that the format would parse as parameters. The format has no
/// escape syntax.
fn refuse_braces(steps: &[Step]) -> Result<()> {
    for step in steps {
        let own = step.tasks.as_ref().map(|(parameter, _)| number(parameter));
        let braces = |text: &&String| text.contains("{{") || text.contains("}}");
        let found = step.arguments.iter().filter(|text| Some(*text) != own.as_ref()).find(braces);
        if let Some(argument) = found {
            return Err(
                format!("argument `{argument}`: jobs do not support `{{{{` or `}}}}` in arguments").into()
            );
        }
    }
    Ok(())
}

fn template(name: &str, program: &Path, steps: &[Step]) -> Value {
    let steps: Vec<Value> = steps
        .iter()
        .map(|step| {
            let run = json!({ "command": "{{Param.Program}}", "args": step.arguments });
            let mut value = json!({ "name": step.name, "script": { "actions": { "onRun": run } } });
            if let Some((parameter, range)) = &step.tasks {
                let definition = json!({ "name": parameter, "type": "INT", "range": range });
                value["parameterSpace"] = json!({ "taskParameterDefinitions": [definition] });
            }
            if let Some(before) = step.after {
                value["dependencies"] = json!([{ "dependsOn": before }]);
            }
            value
        })
        .collect();
    // The format resolves default paths relative to the template.
    let program = json!({
        "name": "Program",
        "type": "STRING",
        "description": "The `asperity` program on the machine that runs a task.",
        "default": program.display().to_string(),
    });
    json!({ "specificationVersion": VERSION, "name": name, "parameterDefinitions": [program], "steps": steps })
}

/// Formats a value in YAML block style. Strings are quoted as in JSON, which YAML accepts.
fn yaml(value: &Value) -> String {
    fn lines(value: &Value, indent: usize, text: &mut String) {
        let pad = " ".repeat(indent);
        match value {
            Value::Object(map) => map.iter().for_each(|(key, value)| {
                *text += &format!("{pad}{key}:");
                nested(value, indent + 2, text);
            }),
            Value::Array(items) => items.iter().for_each(|item| {
                let mut inner = String::new();
                lines(item, indent + 2, &mut inner);
                *text += &format!("{pad}- {}", inner.trim_start());
            }),
            scalar => *text += &format!("{pad}{scalar}\n"),
        }
    }
    fn nested(value: &Value, indent: usize, text: &mut String) {
        let block = match value {
            Value::Object(map) => !map.is_empty(),
            Value::Array(items) => !items.is_empty(),
            _ => false,
        };
        if block {
            *text += "\n";
            lines(value, indent, text);
        } else {
            *text += &format!(" {value}\n");
        }
    }
    let mut text = String::new();
    lines(value, 0, &mut text);
    text
}

/// Returns the arguments of this process for a call on another machine in another folder. Paths of
/// existing files become absolute. The options in `without`, each of which has a value, are
/// removed.
pub(crate) fn arguments(
    given: impl Iterator<Item = String>,
    without: &[&str],
) -> Result<Vec<String>, Failure> {
    let whole = |text: &str| -> Result<String> {
        let path = Path::new(text);
        let there = path.is_relative() && path.is_file();
        Ok(if there { std::path::absolute(path)?.display().to_string() } else { text.to_owned() })
    };
    let (mut arguments, mut given) = (Vec::new(), given);
    while let Some(argument) = given.next() {
        let (option, value) = match argument.split_once('=') {
            Some((option, value)) if option.starts_with("--") => (option, Some(value)),
            _ => (argument.as_str(), None),
        };
        if without.contains(&option) {
            if value.is_none() {
                given.next();
            }
            continue;
        }
        arguments.push(match value {
            Some(value) => format!("{option}={}", whole(value)?),
            None => whole(&argument)?,
        });
    }
    Ok(arguments)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn steps() -> Vec<Step> {
        let tile = ["bake", "--tile-number", &number("Tile")].map(str::to_owned).to_vec();
        vec![
            Step { name: "Tiles", tasks: Some(("Tile", "1-8".into())), arguments: tile, after: None },
            Step { name: "Assemble", tasks: None, arguments: vec!["a: \"b\"".into()], after: Some("Tiles") },
        ]
    }

    #[test]
    fn template_has_steps_tasks_and_order() {
        let template = template("asperity", Path::new("/bin/asperity"), &steps());
        assert_eq!(template["specificationVersion"], VERSION);
        let [first, second] = [0, 1].map(|k| &template["steps"][k]);
        assert_eq!(first["parameterSpace"]["taskParameterDefinitions"][0]["range"], "1-8");
        assert_eq!(first["script"]["actions"]["onRun"]["args"][2], "{{Task.Param.Tile}}");
        assert_eq!(second["dependencies"][0]["dependsOn"], "Tiles");
        assert!(first.get("dependencies").is_none() && second.get("parameterSpace").is_none());
        assert_eq!(template["parameterDefinitions"][0]["default"], "/bin/asperity");
    }

    #[test]
    fn write_refuses_double_braces_in_arguments() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("job.yaml");
        for name in ["a{{b", "a}}b", "{{Param.Program}}", "--out={{"] {
            let mut steps = steps();
            steps[1].arguments.push(name.into());
            let said = write(&file, "asperity", Path::new("a"), &steps).unwrap_err().to_string();
            assert!(said.contains(&format!("`{name}`")) && !said.contains('\n'), "{said}");
            assert!(!file.exists());
        }
        assert!(write(&file, "asperity", Path::new("a"), &steps()).is_ok());
    }

    #[test]
    fn yaml_indents_by_two_and_quotes_as_json() {
        let value = json!({ "name": "a", "steps": [{ "args": ["x: 1", "{{y}}"], "b": { "c": [] } }] });
        let lines = [
            "name: \"a\"",
            "steps:",
            "  - args:",
            "      - \"x: 1\"",
            "      - \"{{y}}\"",
            "    b:",
            "      c: []",
        ];
        assert_eq!(yaml(&value), lines.join("\n") + "\n");
    }

    #[test]
    fn arguments_drop_task_options_and_make_paths_absolute() {
        let given = [
            "render",
            "--job",
            "j.yaml",
            "--mesh",
            "Cargo.toml",
            "--light=Cargo.toml",
            "--frame=3",
            "--size",
            "64",
        ];
        let kept = arguments(given.map(str::to_owned).into_iter(), &["--job", "--frame"]).unwrap();
        let file = std::path::absolute("Cargo.toml").unwrap().display().to_string();
        assert_eq!(kept, ["render", "--mesh", &file, &format!("--light={file}"), "--size", "64"]);
    }
}
