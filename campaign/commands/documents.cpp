// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/commands/documents.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "campaign/base/process/version.hpp"

namespace haff::campaign {
namespace {

using Options = std::vector<const CLI::Option*>;

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  auto commands = app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); });
  return {commands.begin(), commands.end()};
}

Options options_of(const CLI::App& app) {
  return app.get_options(
      [](const CLI::Option* o) { return !o->get_group().empty() && o->nonpositional(); });
}

Options positionals_of(const CLI::App& app) {
  return app.get_options([](const CLI::Option* o) { return o->get_positional(); });
}

// "-h", "--help"
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_value(const CLI::Option& option) {
  return option.get_items_expected_max() > 0;
}

// The name of a value without the checks on it: "K" of "K:INT in [1 - 1024]".
std::string value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

// "table", "csv", "json" of "table|csv|json"; nothing where any value will do.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string value = value_of(option);
  if (value.find('|') == std::string::npos) return {};
  std::vector<std::string> choices;
  std::istringstream text(value);
  for (std::string choice; std::getline(text, choice, '|');) choices.push_back(choice);
  return choices;
}

bool is_folder(const CLI::Option& option) {
  return value_of(option).starts_with("DIR");
}
bool is_file(const CLI::Option& option) {
  return value_of(option).starts_with("FILE");
}

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

// ---- man --------------------------------------------------------------------------------------

// For roff a line that begins with . or ' is a request.
std::string roff(const std::string& text) {
  std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  escaped = replaced(replaced(escaped, "\n.", "\n\\&."), "\n'", "\n\\&'");
  return !escaped.empty() && (escaped[0] == '.' || escaped[0] == '\'') ? "\\&" + escaped : escaped;
}

std::string as_it_stands(const std::string& text) {
  return text.empty() ? "" : fmt::format(".PP\n.nf\n{}\n.fi\n", roff(text));
}

void add_options(const CLI::App& app, std::string& page) {
  Options all = positionals_of(app);
  const Options options = options_of(app);
  all.insert(all.end(), options.begin(), options.end());
  for (const CLI::Option* option : all) {
    std::vector<std::string> names = names_of(*option);
    if (names.empty()) names = {option->get_name(true)};
    std::string head;
    for (const std::string& name : names) head += (head.empty() ? "" : ", ") + roff(name);
    page += fmt::format(".TP\n\\fB{}\\fR", head);
    if (takes_value(*option) && option->nonpositional())
      page += fmt::format(" \\fI{}\\fR", roff(value_of(*option)));
    page += fmt::format("\n{}", roff(option->get_description()));
    if (const std::string value = option->get_default_str(); !value.empty())
      page += fmt::format(" (default: {})", roff(value));
    page += '\n';
  }
}

std::string man_page(const CLI::App& app) {
  const std::string& name = app.get_name();
  std::string page = fmt::format(
      ".TH {} 1 \"\" \"{}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {}\n"
      "[\\fIOPTIONS\\fR] \\fICOMMAND\\fR [\\fIARGUMENTS\\fR]\n.SH OPTIONS\n",
      replaced(name, "campaign", "CAMPAIGN"), roff(code_version()), name,
      roff(app.get_description()), name);
  add_options(app, page);
  page += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(app)) {
    page += fmt::format(".SS {} {}\n{}\n", name, command->get_name(),
                        roff(command->get_description()) + ".");
    add_options(*command, page);
    page += as_it_stands(command->get_footer());
  }
  page += ".SH NOTES\n" + as_it_stands(app.get_footer());
  return page;
}

// ---- bash -------------------------------------------------------------------------------------

std::string words_of(const CLI::App& app) {
  std::string words;
  for (const CLI::Option* option : options_of(app))
    for (const std::string& name : names_of(*option)) words += (words.empty() ? "" : " ") + name;
  return words;
}

// What follows an option: files, folders, one of a few words, or something that cannot be guessed.
void add_bash_values(const CLI::App& app, const std::string& command, std::string& script) {
  for (const CLI::Option* option : options_of(app)) {
    if (!takes_value(*option)) continue;
    std::string reply = "COMPREPLY=()";
    if (is_folder(*option)) reply = "compopt -o filenames; COMPREPLY=($(compgen -d -- \"$cur\"))";
    if (is_file(*option)) reply = "compopt -o filenames; COMPREPLY=($(compgen -f -- \"$cur\"))";
    if (const auto choices = choices_of(*option); !choices.empty())
      reply = fmt::format("COMPREPLY=($(compgen -W \"{}\" -- \"$cur\"))", fmt::join(choices, " "));
    for (const std::string& name : names_of(*option))
      script += fmt::format("    {}:{}) {}; return ;;\n", command, name, reply);
  }
}

std::string bash_completion(const CLI::App& app) {
  std::string commands, values, words;
  for (const CLI::App* command : commands_of(app)) {
    commands += (commands.empty() ? "" : " ") + command->get_name();
    add_bash_values(*command, command->get_name(), values);
    const Options positionals = positionals_of(*command);
    const bool wants_file =
        std::any_of(positionals.begin(), positionals.end(),
                    [](const CLI::Option* o) { return is_file(*o) || value_of(*o) == "NAME..."; });
    words += fmt::format("    {}) words=\"{} {}\"; files={} ;;\n", command->get_name(),
                         words_of(*command), words_of(app), wants_file ? "yes" : "no");
  }
  add_bash_values(app, "*", values);
  return fmt::format(R"(# Completion of {0} for bash. Made by `{0} document bash`.
_{0}() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD-1]}}
  local commands="{1}" command= word words files=no
  # bash takes --store=FILE apart at the sign.
  [[ $previous == "=" ]] && previous=${{COMP_WORDS[COMP_CWORD-2]}}
  [[ $cur == "=" ]] && cur=
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    [[ " $commands " == *" $word "* ]] && {{ command=$word; break; }}
  done
  case $command:$previous in
{2}  esac
  case $command in
{3}    *) words="$commands {4}" ;;
  esac
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
  if [[ $files == yes && $cur != -* ]]; then
    compopt -o filenames
    COMPREPLY=($(compgen -f -- "$cur"))
  fi
}}
complete -F _{0} {0}
)",
                     app.get_name(), commands, values, words, words_of(app));
}

// ---- zsh --------------------------------------------------------------------------------------

// Between single quotes, in a specification of _arguments.
std::string zsh_text(const std::string& text) {
  std::string safe = replaced(text, "'", "'\\''");
  for (const char* special : {"[", "]", ":"})
    safe = replaced(safe, special, std::string("\\") + special);
  return safe;
}

std::string zsh_action(const CLI::Option& option) {
  if (is_folder(option)) return "_files -/";
  if (is_file(option)) return "_files";
  if (const auto choices = choices_of(option); !choices.empty())
    return fmt::format("({})", fmt::join(choices, " "));
  return " ";
}

std::string zsh_arguments(const CLI::App& app, const std::string& indent) {
  std::string lines;
  for (const CLI::Option* option : options_of(app)) {
    for (const std::string& name : names_of(*option)) {
      lines += fmt::format("{}'{}[{}]", indent, name, zsh_text(option->get_description()));
      if (takes_value(*option))
        lines += fmt::format(":{}:{}", zsh_text(value_of(*option)), zsh_action(*option));
      lines += "' \\\n";
    }
  }
  for (const CLI::Option* option : positionals_of(app))
    lines +=
        fmt::format("{}'{}:{}:{}' \\\n", indent, option->get_items_expected_max() > 1 ? "*" : "",
                    zsh_text(option->get_name(true)), zsh_action(*option));
  return lines;
}

std::string zsh_completion(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(app)) {
    commands +=
        fmt::format("    '{}:{}'\n", command->get_name(), zsh_text(command->get_description()));
    cases += fmt::format("    {}) _arguments \\\n{}{}      && return ;;\n", command->get_name(),
                         zsh_arguments(*command, "      "), zsh_arguments(app, "      "));
  }
  return fmt::format(R"(#compdef {0}
# Completion of {0} for zsh. Made by `{0} document zsh`.
local state line
local -a commands
commands=(
{1})
_arguments -C \
{2}  '1:command:->command' '*::argument:->arguments'
case $state in
  command) _describe command commands ;;
  arguments) case $line[1] in
{3}  esac ;;
esac
)",
                     app.get_name(), commands, zsh_arguments(app, "  "), cases);
}

// ---- fish -------------------------------------------------------------------------------------

std::string fish_text(const std::string& text) {
  return replaced(replaced(text, "\\", "\\\\"), "'", "\\'");
}

void add_fish(const CLI::App& app, const std::string& program, const std::string& condition,
              std::string& script) {
  for (const CLI::Option* option : options_of(app)) {
    script += fmt::format("complete -c {}{}", program, condition);
    for (const std::string& name : option->get_snames()) script += " -s " + name;
    for (const std::string& name : option->get_lnames()) script += " -l " + name;
    if (takes_value(*option)) {
      script += is_file(*option) ? " -r -F" : " -x";
      if (is_folder(*option)) script += " -a '(__fish_complete_directories)'";
      if (const auto choices = choices_of(*option); !choices.empty())
        script += fmt::format(" -a '{}'", fmt::join(choices, " "));
    }
    script += fmt::format(" -d '{}'\n", fish_text(option->get_description()));
  }
}

std::string fish_completion(const CLI::App& app) {
  const std::string& program = app.get_name();
  const auto commands = commands_of(app);
  std::string names;
  for (const CLI::App* command : commands) names += ' ' + command->get_name();
  // fish's own __fish_use_subcommand takes FILE in `--store FILE` for the command.
  std::string script = fmt::format(R"(# Completion of {0} for fish. Made by `{0} document fish`.
# Has a command been typed, and is it this one?
function __{0}_command
    set -l words (commandline -opc)
    for word in $words[2..]
        contains -- $word{1}; or continue
        test (count $argv) = 0; or test $word = $argv[1]
        return
    end
    return 1
end
complete -c {0} -f
)",
                                   program, names);
  add_fish(app, program, "", script);
  for (const CLI::App* command : commands) {
    script += fmt::format("complete -c {0} -n 'not __{0}_command' -a {1} -d '{2}'\n", program,
                          command->get_name(), fish_text(command->get_description()));
    const std::string condition =
        fmt::format(" -n '__{}_command {}'", program, command->get_name());
    add_fish(*command, program, condition, script);
    for (const CLI::Option* option : positionals_of(*command))
      if (is_file(*option) || value_of(*option) == "NAME...")
        script += fmt::format("complete -c {}{} -F\n", program, condition);
  }
  return script;
}

}  // namespace

std::string document(const CLI::App& app, const std::string& kind) {
  if (kind == "man") return man_page(app);
  if (kind == "bash") return bash_completion(app);
  if (kind == "zsh") return zsh_completion(app);
  if (kind == "fish") return fish_completion(app);
  throw std::invalid_argument("no document of the command line is called " + kind);
}

}  // namespace haff::campaign
