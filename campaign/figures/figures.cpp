// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/figures/figures.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <functional>
#include <set>
#include <system_error>

#include "campaign/base/output/output_files.hpp"
#include "campaign/base/text/command_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/curves/answer/answer.hpp"
#include "campaign/figures/general.hpp"
#include "campaign/figures/page.hpp"
#include "campaign/paper/claims/agreement.hpp"
#include "campaign/paper/figures.hpp"
#include "campaign/plot/picture.hpp"
#include "campaign/plot/table.hpp"
#include "campaign/results/mixed_physics.hpp"

namespace haff::campaign {
namespace {

bool is_for_all(const FigureRequest& request) {
  return request.only.empty() && request.gases.empty();
}

std::string stem_of(const PaperFigure& figure) {
  return fmt::format("figure-{:02}", figure.id);
}

std::string stem_of(const GeneralFigure& figure) {
  return fmt::format("gas-{}", figure.name);
}

std::vector<PaperFigure> asked_of_paper(const FigureRequest& request) {
  const auto figures = paper_figures();
  if (is_for_all(request)) return {figures.begin(), figures.end()};
  std::vector<PaperFigure> asked;
  for (const int id : request.only) {
    const auto found = std::ranges::find(figures, id, &PaperFigure::id);
    if (found == figures.end())
      throw UnknownFigure(fmt::format("figure {}: there is none; figures are numbered 1 to {}", id,
                                      figures.back().id));
    asked.push_back(*found);
  }
  return asked;
}

std::vector<GeneralFigure> asked_of_gases(const FigureRequest& request) {
  const auto figures = general_figures();
  if (is_for_all(request)) return {figures.begin(), figures.end()};
  std::vector<GeneralFigure> asked;
  for (const std::string& name : request.gases) {
    const auto found = std::ranges::find(figures, name, &GeneralFigure::name);
    if (found == figures.end()) {
      std::string names;
      for (const GeneralFigure& each : figures)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", each.name);
      throw UnknownFigure(fmt::format(
          "figure {}: there is none; those that are not the paper's are {}", name, names));
    }
    asked.push_back(*found);
  }
  return asked;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(
        fmt::format("{}: folder cannot be made: {}", folder.string(), error.message()));
  }
}

// The plot, or why there is none.
struct Attempt {
  std::optional<Plot> plot = {};
  std::string error = {};  // empty: the store lacks its data
};

template <class Make>
Attempt attempt(Make&& make) {
  try {
    return {.plot = make()};
  } catch (const NothingToDraw&) {
    return {};
  } catch (const QuestionError&) {  // a column or profile that this store has not
    return {};
  } catch (const std::exception& error) {
    return {.plot = {}, .error = printable(error.what())};
  }
}

// Draws one figure after another into a folder, and keeps what the page says of them.
class Drawing {
 public:
  Drawing(const std::filesystem::path& folder, std::ostream& report)
      : folder_(folder), report_(report) {}

  // Whether it was drawn. A figure that the store has no data for is no entry.
  bool draw(const Attempt& attempt, const std::string& stem, const std::string& head,
            FigureEntry entry, std::vector<FigureEntry>& entries) {
    if (!attempt.error.empty()) {
      entry.caption = "not drawn: " + attempt.error;
      fmt::print(report_, "{}cannot be drawn: {}\n", head, attempt.error);
      failed_ = true;
      entries.push_back(entry);
    }
    if (!attempt.plot) return false;
    const Plot& plot = *attempt.plot;
    const auto file = folder_ / stem;
    const std::size_t before = files_.written().size();
    files_.attempt(file.string() + ".csv", [&](const auto& csv) { write_table(plot, csv); });
    draw_both(plot, file, files_);
    made_.insert(stem);
    entry.caption = printable(plot.caption);
    entry.width = plot.width;
    std::vector<std::string> endings;
    for (std::size_t i = before; i < files_.written().size(); ++i) {
      const auto& written = files_.written()[i];
      endings.push_back(written.extension().string().substr(1));
      if (endings.back() == "csv")
        entry.table = written.filename().string();
      else if (entry.picture.empty())
        entry.picture = written.filename().string();
    }
    fmt::print(report_, "{}{} ({})\n           {}\n", head, file.string(),
               endings.empty() ? "nothing written" : fmt::format("{}", fmt::join(endings, ", ")),
               entry.caption);
    entries.push_back(std::move(entry));
    return true;
  }

  // Pictures and tables in the folder that an earlier run made and this one did not.
  std::vector<std::string> left_from_before() const {
    std::vector<std::string> names;
    const auto look_for = [&](const std::string& stem) {
      if (made_.contains(stem)) return;
      std::error_code ignored;
      for (const char* ending : {".csv", ".svg", ".png"})
        if (std::filesystem::exists(folder_ / (stem + ending), ignored))
          names.push_back(stem + ending);
    };
    for (const PaperFigure& figure : paper_figures()) look_for(stem_of(figure));
    for (const GeneralFigure& figure : general_figures()) look_for(stem_of(figure));
    return names;
  }

  OutputFiles& files() { return files_; }
  std::size_t drawn() const { return made_.size(); }
  bool has_failed() const { return failed_; }

 private:
  std::filesystem::path folder_;
  std::ostream& report_;
  OutputFiles files_;
  std::set<std::string> made_;
  bool failed_ = false;
};

// The paper's figures; returns those that the store has no data for.
std::vector<PaperFigure> draw_paper(const std::vector<PaperFigure>& asked, const Averages& averages,
                                    Drawing& drawing, std::vector<FigureEntry>& entries) {
  std::vector<PaperFigure> lacking;
  for (const PaperFigure& figure : asked) {
    const Attempt made = attempt([&] { return figure.make(averages); });
    drawing.draw(made, stem_of(figure), fmt::format("figure {:>2}  {}: ", figure.id, figure.title),
                 {.name = stem_of(figure),
                  .title = fmt::format("Figure {}: {}", figure.id, figure.title),
                  .published = std::string(figure.published)},
                 entries);
    if (!made.plot && made.error.empty()) lacking.push_back(figure);
  }
  return lacking;
}

std::vector<std::string> draw_gases(const std::vector<GeneralFigure>& asked,
                                    const schema::Reader& store, Drawing& drawing,
                                    std::vector<FigureEntry>& entries) {
  std::vector<std::string> lacking;
  for (const GeneralFigure& figure : asked) {
    const Attempt made =
        attempt([&] { return std::optional(answer(store, figure.question).plot); });
    drawing.draw(made, stem_of(figure), fmt::format("{}: ", figure.title),
                 {.name = stem_of(figure), .title = std::string(figure.title)}, entries);
    if (!made.plot && made.error.empty()) lacking.emplace_back(figure.name);
  }
  return lacking;
}

// What to plan is said where it was asked for, or nothing else is there to be said.
void report_lacking(const std::vector<PaperFigure>& lacking, bool with_plans,
                    const schema::Reader& store, std::ostream& report) {
  if (with_plans) {
    for (const PaperFigure& figure : lacking)
      fmt::print(report,
                 "figure {:>2}  {}: the store has no finished jobs for it; plan, for example\n{}\n",
                 figure.id, figure.title, figure.plan);
    return;
  }
  if (lacking.empty()) return;
  std::vector<int> numbers;
  numbers.reserve(lacking.size());
  for (const PaperFigure& figure : lacking) numbers.push_back(figure.id);
  fmt::print(
      report,
      "The store has no finished jobs for the paper's figure{} {}. What to plan for one: {}\n",
      numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "),
      command_text(fmt::format("figures --only {}", numbers.front()), store.path()));
}

}  // namespace

int draw_figures(const schema::Reader& store, const FigureRequest& request, std::ostream& report) {
  const auto of_paper = asked_of_paper(request);
  const auto of_gases = asked_of_gases(request);
  const bool is_page = is_for_all(request);
  for (const std::string& sentence : mixed_physics(store))
    fmt::print(report, "Note: {}\n", sentence);
  make_folder(request.out);

  Drawing drawing(request.out, report);
  Page page;
  const Averages averages = of_paper.empty() ? Averages{} : read_averages(store);
  const auto lacking = draw_paper(of_paper, averages, drawing, page.paper);
  const auto lacking_gases = draw_gases(of_gases, store, drawing, page.gases);
  report_lacking(lacking, !is_page || drawing.drawn() == 0, store, report);
  if (!is_page)
    for (const std::string& name : lacking_gases)
      fmt::print(report, "{}: no finished run has what it shows\n", name);

  if (is_page && drawing.drawn() > 0) {
    for (const PaperFigure& figure : lacking)
      page.lacking.push_back(fmt::format("{} ({})", figure.id, figure.title));
    page.from_before = drawing.left_from_before();
    if (!page.paper.empty()) page.agreement = agreement(averages);
    if (!page.agreement.empty())
      drawing.files().attempt(request.out / "agreement.csv",
                              [&](const auto& file) { write_agreement(page.agreement, file); });
    if (drawing.files().attempt(request.out / "index.html",
                                [&](const auto& file) { write_page(page, file); }))
      fmt::print(report, "all of them on one page: {}\n", (request.out / "index.html").string());
    if (!page.from_before.empty())
      fmt::print(report, "Of an earlier run, not of this store: {}\n",
                 fmt::join(page.from_before, ", "));
  }
  drawing.files().print_missing(report);
  const bool complete =
      is_page ? drawing.drawn() > 0 : drawing.drawn() == of_paper.size() + of_gases.size();
  return complete && !drawing.has_failed() && drawing.files().is_complete() ? 0 : 1;
}

}  // namespace haff::campaign
