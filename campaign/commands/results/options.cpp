// SPDX-License-Identifier: GPL-3.0-or-later

// The options of query, figures, plot, export, cost, report, theory.
#include "campaign/commands/options.hpp"

#include <algorithm>
#include <charconv>

#include "campaign/base/text/number_text.hpp"

namespace haff::campaign {

namespace {

constexpr int most_ports = 65'535;

void add_format(CLI::App& command, RowFormat& format) {
  const auto set_format = [&format](const std::string& name) {
    format = name == "csv" ? RowFormat::csv : name == "json" ? RowFormat::json : RowFormat::table;
  };
  command.add_option_function<std::string>("--format", set_format, "How to print the rows")
      ->check(CLI::IsMember({"table", "csv", "json"}))
      ->type_name("table|csv|json")
      ->default_str("table");
}

}  // namespace

CLI::App* add_query(CLI::App& app, QueryCommand& options) {
  auto* command = app.add_subcommand("query", "Ask the store one question in SQL");
  command->add_option("SQL", options.sql, "One statement that reads")
      ->type_name("TEXT")
      ->required();
  add_format(*command, options.format);
  command->footer(
      examples(R"(  campaign query "SELECT e, n, particles, tau_c, tau_c_se FROM mean_tau_c"
  campaign query "SELECT tau, a2, a2_se FROM mean_series WHERE e = 0.9" --format csv > a2.csv
  campaign query "SELECT * FROM jobs" --format json)"));
  return command;
}

CLI::App* add_figures(CLI::App& app, FigureRequest& options) {
  auto* command =
      app.add_subcommand("figures", "Draw the paper's figures and those of all gases, and a page");
  command->add_option("--out", options.out, "Folder to write to")
      ->type_name("DIR")
      ->capture_default_str();
  const auto set_only = [&options](const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const auto number = number_in(name);
      if (number && *number == static_cast<int>(*number))
        options.only.push_back(static_cast<int>(*number));
      else
        options.gases.push_back(name);
    }
  };
  command
      ->add_option_function<std::vector<std::string>>(
          "--only", set_only, "Numbers of the paper's figures and names of others, e.g. 1,2,energy")
      ->type_name("LIST")
      ->delimiter(',');
  command->footer(examples(R"(  campaign figures
  campaign figures --out paper --only 1,2,11
  campaign figures --only energy,a2,pressure

The paper's figures, where the store has its gases, and figures of all the gases that it has; each as
CSV, SVG and PNG, and all on one page. `campaign plot` draws other questions.)"));
  return command;
}

CLI::App* add_plot(CLI::App& app, PlotOptions& options) {
  Question& question = options.question;
  auto* command = app.add_subcommand("plot", "Draw a question of your own: this against that");
  command
      ->add_option("Y", question.y,
                   "A column, a profile, a quantity, or an SQL expression in columns; --list names "
                   "them")
      ->type_name("NAME");
  command
      ->add_option("--against", question.against,
                   "tau, time, a parameter (e, n, N, roughness.beta), a profile's variable, or an "
                   "expression")
      ->type_name("NAME");
  command
      ->add_option("--by", question.by,
                   "Parameters that colours and legend go by; by default all that vary")
      ->type_name("LIST")
      ->delimiter(',');
  command
      ->add_option("--where", question.where,
                   "Which gases and samples, a condition in SQL: \"e < 0.9 AND N = 8000\"")
      ->type_name("SQL");
  const auto set_log = [&question](const std::vector<std::string>& axes) {
    question.log_x = std::ranges::count(axes, "x") > 0;
    question.log_y = std::ranges::count(axes, "y") > 0;
  };
  command
      ->add_option_function<std::vector<std::string>>("--log", set_log,
                                                      "Logarithmic axes: x, y or x,y")
      ->check(CLI::IsMember({"x", "y"}))
      ->type_name("AXES")
      ->delimiter(',');
  command->add_flag("--theory", question.theory, "With the lines of theory for these gases");
  const auto set_difference = [&question](const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw CLI::ValidationError(
          "--difference", "'" + text + "' is no reference; expected e.g. e=0.9 or roughness=none");
    question.difference = {text.substr(0, equals), text.substr(equals + 1)};
  };
  command
      ->add_option_function<std::string>("--difference", set_difference,
                                         "Subtract, seed by seed, the gas with this value: e=0.9; "
                                         "without an effect: roughness=none")
      ->type_name("PARAMETER=VALUE");
  const auto set_out = [&options](const std::string& text) {
    options.out = text;
    if (!is_plot_file(*options.out))
      throw CLI::ValidationError("--out",
                                 "'" + text + "': expected a name that ends in .svg, .png or .csv");
  };
  command
      ->add_option_function<std::string>("--out", set_out,
                                         "Picture or table, by its suffix .svg, .png or .csv; "
                                         "without, the picture is printed as text")
      ->type_name("FILE");
  command->add_flag("--list", options.list, "List what can be drawn from the store");
  command->footer(examples(R"(  campaign plot --list
  campaign plot a2 --against tau --by e --theory
  campaign plot energy --log y --by n --where "d = 3 AND N = 8000" --out energy.svg
  campaign plot a2 --against roughness.beta --by n          the mean over tau 5 to 15
  campaign plot pressure@20 --against n --by e --theory --out pressure.csv
  campaign plot tau_c --against N --by e --log x
  campaign plot G_parallel --against r --where "tau = 50"
  campaign plot "temperature_1/temperature_2" --against tau --by mixture.mass_ratio
  campaign plot gamma_ratio --against tau --difference e=0.9 --out difference.png

A curve is the mean over realizations of one gas, with the 68 % interval of the mean by Student's t;
gases that differ are never averaged. In --where, N is the number of particles and roughness.beta
the effect's parameter; tau thins samples too ("tau % 5 = 0").

Exit code 1 if no finished run has what is asked for, 2 if a name or the SQL is not known.)"));
  return command;
}

CLI::App* add_export(CLI::App& app, ExportOptions& options) {
  auto* command = app.add_subcommand(
      "export", "Print a job's gas as extended XYZ, for OVITO, ASE and chemfiles");
  command->add_option("JOB", options.job_id, "The job_id, as in the table jobs")
      ->type_name("NUMBER")
      ->required();
  auto* at = command->add_option("--at", options.at_tau,
                                 "The snapshot at this tau; without, the last stored state");
  at->type_name("TAU");
  auto* at_time = command->add_option("--at-time", options.at_time, "The snapshot at this time");
  at_time->type_name("TIME")->excludes(at);
  auto* all =
      command->add_flag("--all", options.all, "All snapshots, one after the other: a trajectory");
  all->excludes(at)->excludes(at_time);
  command->add_flag("--list", options.list, "List what can be exported")
      ->excludes(at)
      ->excludes(at_time)
      ->excludes(all);
  command->footer(examples(
      R"(  campaign query "SELECT job_id, kind, e, n, particles, seed, tau_reached FROM jobs"
  campaign export 3 --list
  campaign export 3 > job-3.xyz          the newest state; its tau stands in the second line
  campaign export 3 --at 20 > at-20.xyz  a snapshot: list its tau in the grid's "snapshots_at"
  campaign export 3 --all | gzip > job-3.xyz.gz

Each particle has its species (H, and He for the second of a mixture), position, velocity, radius,
mass, id and, where particles are rough, angular velocity; the second line has cell and periodicity.
Units are sigma, m and E(0).)"));
  return command;
}

CLI::App* add_cost(CLI::App& app, CostRequest& options) {
  auto* command = app.add_subcommand("cost", "Show what accuracy costs in CPU time");
  command->add_option("--out", options.out, "Folder to write to")
      ->type_name("DIR")
      ->capture_default_str();
  const auto set_target = [&options](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const auto target = target_from_text(text);
      if (!target)
        throw CLI::ValidationError("--target",
                                   "'" + text +
                                       "' is no target; expected a quantity and an error above 0, "
                                       "e.g. a2=5e-4, over a window of tau a2@3:8=5e-4, at one "
                                       "tau gamma_ratio@20=1e-3; quantities: a2, a3, a4, "
                                       "gamma_ratio, ln_temperature, tau_c, G_parallel");
      options.targets.push_back(*target);
    }
  };
  command
      ->add_option_function<std::vector<std::string>>("--target", set_target,
                                                      "The error to advise on, e.g. a2=5e-4; of "
                                                      "other tau than usual a2@3:8=5e-4")
      ->type_name("QUANTITY[@TAU]=ERROR")
      ->delimiter(',');
  command->footer(examples(R"(  campaign cost
  campaign cost --target a2=5e-4,tau_c=0.5
  campaign cost --target a2@3:8=5e-4,gamma_ratio@20=1e-3,ln_temperature@50=0.01
  campaign cost --out accuracy

TAU is a window FROM:TO (a2, a3, a4, gamma_ratio), or one tau (gamma_ratio: 2 to either side,
ln_temperature, G_parallel). Quantities that a grid has a "target" for are in the table too.

Exit code 1 if no cooling run is done: it then says what to plan.)"));
  return command;
}

CLI::App* add_report(CLI::App& app, ReportOptions& options) {
  auto* command =
      app.add_subcommand("report", "Write the store as a page for any browser, in one file");
  command->add_option("--out", options.out, "Folder to write report.html to")
      ->type_name("DIR")
      ->capture_default_str();
  const auto set_port = [&options](const std::string& text) {
    options.serve = true;
    if (text.empty()) return;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), options.port);
    if (error != std::errc() || end != text.data() + text.size() || options.port < 1 ||
        options.port > most_ports)
      throw CLI::ValidationError("--serve", "'" + text + "' is no port; expected 1 to 65535");
  };
  command
      ->add_option_function<std::string>("--serve", set_port,
                                         "Serve the page on 127.0.0.1 instead, refreshed while a "
                                         "run is on, until Ctrl-C; any port that is free unless "
                                         "one is named")
      ->expected(0, 1)
      ->type_name("[PORT]")
      ->excludes("--out");
  command->footer(examples(R"(  campaign report                  writes report/report.html
  campaign report --out /tmp       open it in any browser, or mail it: it needs no network
  campaign report --serve          prints an address for a browser on this machine
  campaign report --serve 8080     from another machine: ssh -L 8080:127.0.0.1:8080 HOST

Only this machine can ask the server, and only with the token in the address that is printed. It
never writes the store.)"));
  return command;
}

CLI::App* add_theory(CLI::App& app, TheoryOptions& options) {
  auto* command = app.add_subcommand("theory", "Print a theory curve: table, CSV or JSON");
  command->add_option("CURVE", options.curve, "The curve; --list names them")->type_name("NAME");
  command->add_flag("--list", options.list, "List the curves and what they are functions of");
  command->add_option("--d", options.d, "Dimension")
      ->check(CLI::IsMember({2, 3}))
      ->type_name("2|3")
      ->capture_default_str();
  const auto add_values = [command](const char* name, std::vector<double>& values,
                                    const char* what) {
    const auto set = [name, &values](const std::string& text) {
      const auto read = values_from_text(text);
      if (!read)
        throw CLI::ValidationError(name,
                                   "'" + text + "' is no number, list 1,2,5 or range FROM:TO:STEP");
      values = *read;
    };
    command->add_option_function<std::string>(name, set, what)->type_name("VALUES");
  };
  add_values("--e", options.e, "Restitution coefficient (0.85)");
  add_values("--n", options.n, "Number density [sigma^-d] (0.4)");
  add_values("--tau", options.tau, "Collisions per particle (0:40:1; of curves in r 50)");
  add_values("--r", options.r, "Distances [sigma] (1:20:0.5)");
  add_values("--k", options.k, "Wave numbers [1/sigma] (0.02:1:0.02)");
  command->add_option("--b", options.b, "Cutoff number of the energy equation")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      ->add_option("--effects", options.effects, "As in a grid: restitution, thermostat, shuffle")
      ->type_name("JSON")
      ->capture_default_str();
  command
      ->add_option("--particles", options.particles,
                   "Particles of a direct simulation that is computed now")
      ->check(CLI::Range(2, 100'000'000))
      ->capture_default_str();
  command
      ->add_option("--realizations", options.realizations,
                   "Its realizations; errors fall as one over their square root")
      ->check(CLI::Range(2, 1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options.seed, "Its seed")->capture_default_str();
  add_format(*command, options.format);
  command->footer(R"(Examples:
  campaign theory --list
  campaign theory a2 --d 3 --e 0.85 --tau 0:40:1 --format csv
  campaign theory gamma_ratio --e 0.9 --n 0.4 --tau 0:100:5
  campaign theory tau_c --e 0.80,0.85,0.90,0.95
  campaign theory G_parallel --e 0.8 --tau 50 --r 2:30:0.5
  campaign theory a2 --e 0.77 --realizations 64
  campaign theory temperature --effects '{"restitution": {"law": "viscoelastic", "A": 0.05}}'

VALUES are a number, a list 1,2,5 or a range FROM:TO:STEP. Columns:
  second_order      Enskog-Boltzmann theory to first order in a_2 (its plateau is -A/B)
  dsmc, dsmc_se     the Enskog-Boltzmann equation itself by direct simulation, and its standard
                    error: from a table at e = 0.7, 0.8, 0.85, 0.865, 0.9, 0.95, 0.98, 1, else
                    computed now (--particles, --realizations; some ten seconds)
  energy_equation   with velocity correlations; non_gaussian: a_2 taken into account as well
chi, the pair correlation at contact, is Carnahan and Starling's (disks: Henderson's). It enters the
lengths, and so every curve with correlations, collision_rate and Z, and the unit of time of laws
that have one. The collision rate of elastic spheres is higher by 0.006, 0.02, 0.08, 0.24 and
0.31 % at n = 0.05, 0.1, 0.2, 0.4 and 0.5.
No store is read. A shuffle changes nothing in a homogeneous gas: theory is the same without it.)");
  return command;
}

}  // namespace haff::campaign
