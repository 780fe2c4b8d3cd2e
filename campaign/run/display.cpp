// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/run/display.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "campaign/base/output/output.hpp"
#include "campaign/base/output/terminal.hpp"
#include "campaign/base/text/duration.hpp"
#include "campaign/base/text/printable.hpp"

namespace haff::campaign {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_every = 200ms;
constexpr auto line_every = 10s;

std::string rate_text(double per_second) {
  return per_second >= 1e5 ? fmt::format("{:5.2f} M collisions/s", per_second / 1e6)
                           : fmt::format("{:5.1f} k collisions/s", per_second / 1e3);
}

std::string bar(double fraction, std::size_t width) {
  const auto filled = static_cast<std::size_t>(
      std::lround(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(width)));
  return '[' + std::string(filled, '#') + std::string(width - filled, '.') + ']';
}

std::string totals_text(const Totals& totals) {
  std::string text =
      fmt::format("{:5.1f} %  {} of {} jobs done", 100 * totals.fraction, totals.done, totals.jobs);
  if (totals.failed > 0) text += fmt::format(", {} failed", totals.failed);
  if (totals.seconds_left) text += fmt::format(", {} left", duration_text(*totals.seconds_left));
  return text;
}

spdlog::level::level_enum spdlog_level(LogReport::Level level) {
  switch (level) {
    case LogReport::Level::debug:
      return spdlog::level::debug;
    case LogReport::Level::info:
      return spdlog::level::info;
    case LogReport::Level::warning:
      return spdlog::level::warn;
    case LogReport::Level::error:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

}  // namespace

std::vector<std::string> bars(const std::vector<std::optional<ProgressReport>>& workers,
                              const Totals& totals, std::size_t width, std::size_t height) {
  constexpr std::size_t bar_width = 20;
  std::vector<std::string> lines;
  const bool each_has_a_line = workers.size() + 1 <= height;
  for (const auto& worker : workers) {
    if (!each_has_a_line) break;
    if (!worker) {
      lines.emplace_back(bar(0, bar_width) + " waiting");
      continue;
    }
    lines.push_back(fmt::format("{} tau {:6.1f}/{:<5g} {}  job {} {}",
                                bar(worker->tau / worker->tau_max, bar_width), worker->tau,
                                worker->tau_max, rate_text(worker->collisions_per_second),
                                worker->job_id, printable(worker->job)));
  }
  lines.push_back(bar(totals.fraction, bar_width) + ' ' + totals_text(totals));
  for (std::string& line : lines) line.resize(std::min(line.size(), width));
  return lines;
}

std::string plain_line(const std::vector<std::optional<ProgressReport>>& workers,
                       const Totals& totals) {
  std::string running;
  double rate = 0;
  for (const auto& worker : workers) {
    if (!worker) continue;
    rate += worker->collisions_per_second;
    running += fmt::format("{}job {} tau {:.1f}/{:g}", running.empty() ? "" : ", ", worker->job_id,
                           worker->tau, worker->tau_max);
  }
  // A job that has just begun has no rate.
  return fmt::format("{}{}{}{}", totals_text(totals), rate > 0 ? ", " + rate_text(rate) : "",
                     running.empty() ? "" : "; ", running);
}

Display::Display(std::size_t workers)
    : terminal_(isatty(STDERR_FILENO) == 1),
      workers_(workers),
      shown_(std::chrono::steady_clock::now()) {}

Display::~Display() {
  erase_bars();
}

void Display::set(std::size_t worker, std::optional<ProgressReport> report) {
  workers_.at(worker) = std::move(report);
}

void Display::log(LogReport::Level level, const std::string& text) {
  if (!spdlog::should_log(spdlog_level(level))) return;
  erase_bars();
  spdlog::log(spdlog_level(level), "{}", text);
}

bool Display::is_due() const {
  const auto since = std::chrono::steady_clock::now() - shown_;
  return terminal_ ? since >= redraw_every : since >= line_every;
}

void Display::show(const Totals& totals) {
  shown_ = std::chrono::steady_clock::now();
  terminal_ ? draw_bars(totals) : write_line(totals);
}

void Display::draw_bars(const Totals& totals) {
  erase_bars();
  // One column stays free, since a full line would wrap on some terminals, and one line, on which
  // the cursor stands.
  const TerminalSize size = terminal_size(STDERR_FILENO);
  const auto lines = bars(workers_, totals, static_cast<std::size_t>(size.columns - 1),
                          static_cast<std::size_t>(size.lines - 1));
  std::string picture;
  for (const std::string& line : lines) picture += line + '\n';
  write_to_stderr(picture);
  lines_drawn_ = lines.size();
}

void Display::write_line(const Totals& totals) const {
  spdlog::info("{}", plain_line(workers_, totals));
}

void Display::erase_bars() {
  if (lines_drawn_ == 0) return;
  write_to_stderr("\033[" + std::to_string(lines_drawn_) + "A\r\033[J");
  lines_drawn_ = 0;
}

}  // namespace haff::campaign
