// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/figures/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "campaign/base/output/write_file.hpp"
#include "campaign/base/process/version.hpp"
#include "campaign/base/text/number_text.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/results/published.hpp"

namespace haff::campaign {
namespace {

constexpr std::string_view style = R"(
  body { font: 16px/1.5 Arial, "Liberation Sans", sans-serif; color: #222; margin: 2rem auto;
         max-width: 78rem; padding: 0 clamp(0.5rem, 3vw, 1.5rem); background: #fff; }
  h1 { font-size: 1.7rem; margin-bottom: 0.2rem; }
  h2 { font-size: 1.25rem; margin: 2.5rem 0 0.6rem; }
  h3 { font-size: 1.05rem; margin: 0 0 0.5rem; }
  .figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(34rem, 100%), 1fr));
             gap: 2rem; }
  figure { margin: 0; min-width: 0; border: 1px solid #ddd; border-radius: 4px;
           padding: clamp(0.4rem, 2vw, 1rem); }
  figure img { width: 100%; height: auto; display: block; }
  figcaption { font-size: 0.88rem; color: #444; margin-top: 0.5rem; }
  .broad { grid-column: 1 / -1; }
  figcaption p { margin: 0.3rem 0 0; }
  .paper { color: #0072b2; }
  .absent { color: #777; font-style: italic; }
  .wide { overflow-x: auto; }
  table { border-collapse: collapse; font-size: 0.88rem; min-width: 60rem; }
  th, td { text-align: left; padding: 0.25rem 0.8rem 0.25rem 0; border-bottom: 1px solid #e4e4e4;
           vertical-align: top; }
  td.number { text-align: right; white-space: nowrap; }
  .yes { color: #00724f; font-weight: bold; }
  .no { color: #b34700; font-weight: bold; }
)";

std::string number(double value, double error = Comparison::none) {
  return std::isfinite(value) ? value_with_error(value, error) : std::string();
}

std::string deviation(const Comparison& row) {
  if (!std::isfinite(row.value) || !std::isfinite(row.reference) || row.reference == 0) return "";
  return fmt::format("{:+.2f} %", 100 * (row.value / row.reference - 1));
}

std::string verdict(const Comparison& row) {
  if (!row.holds) return "<td></td>";
  return *row.holds ? R"(<td class="yes">✓</td>)" : R"(<td class="no">✗</td>)";
}

std::string table_text(const std::vector<Comparison>& table) {
  std::string text =
      "<div class=\"wide\"><table>\n<tr><th>quantity</th><th>e</th><th>n</th><th>this work</th>"
      "<th>reference</th><th>difference</th><th>held to</th><th></th><th>note</th></tr>\n";
  for (const Comparison& row : table) {
    const std::string reference = std::isfinite(row.reference) && row.reference != 0
                                      ? number(row.reference) + " (" + row.source + ")"
                                      : row.source;
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"number\">{}</td><td>{}</td>"
        "<td class=\"number\">{}</td><td>{}</td>{}<td>{}</td></tr>\n",
        xml_escaped(row.quantity), row.e ? restitution_text(*row.e) : "",
        row.n ? density_text(*row.n) : "", number(row.value, row.half_interval),
        xml_escaped(reference), deviation(row), xml_escaped(row.criterion), verdict(row),
        xml_escaped(row.note));
  }
  return text + "</table></div>\n";
}

std::string figure_text(const FigureEntry& figure) {
  // A broad picture has a row of its own. On a phone pictures shrink to its width, so that nothing
  // is cut off; a tap opens the picture alone, to be looked at in any size.
  constexpr int usual_width = 900;
  std::string text =
      fmt::format("<figure id=\"{}\"{}>\n<h3>{}</h3>\n", xml_escaped(figure.name),
                  figure.width > usual_width ? " class=\"broad\"" : "", xml_escaped(figure.title));
  if (figure.picture.empty())
    text += fmt::format("<p class=\"absent\">{}</p>\n", xml_escaped(figure.caption));
  else
    text += fmt::format(
        "<a href=\"{0}\"><img src=\"{0}\" alt=\"{1}\" style=\"max-width: {2}px\"></a>\n",
        figure.picture, xml_escaped(figure.title), figure.width * 3 / 2);
  text += "<figcaption>";
  // A PNG stands in for an SVG that could not be drawn, and has the caption in it.
  if (figure.picture.ends_with(".svg")) text += xml_escaped(figure.caption) + "\n";
  if (!figure.table.empty())
    text += fmt::format("<a href=\"{}\">All points (CSV)</a>\n", figure.table);
  if (!figure.published.empty())
    text += fmt::format("<p class=\"paper\">Published: {}</p>\n", xml_escaped(figure.published));
  return text + "</figcaption>\n</figure>\n";
}

std::string agreement_text(const std::vector<Comparison>& table) {
  const auto judged = std::ranges::count_if(table, [](const auto& row) { return !!row.holds; });
  const auto held =
      std::ranges::count_if(table, [](const auto& row) { return row.holds.value_or(false); });
  return fmt::format("<h2>Agreement: {} of {} claims hold</h2>\n", held, judged) +
         table_text(table) +
         "<p>± is half the 95 % interval of the mean over realizations, by Student's t. A claim "
         "holds if the value lies nearer to the reference than half the way to the nearest "
         "theory that is known to be wrong; it is not judged where the interval is wider than "
         "that. Claims at different e share their realizations' initial states, so they are not "
         "independent. The same table with all digits: <a href=\"agreement.csv\">"
         "agreement.csv</a>.</p>\n";
}

std::string figures_text(const std::vector<FigureEntry>& figures) {
  std::string text = "<div class=\"figures\">\n";
  for (const FigureEntry& figure : figures) text += figure_text(figure);
  return text + "</div>\n";
}

std::string list_text(const std::vector<std::string>& items) {
  return xml_escaped(fmt::format("{}", fmt::join(items, ", ")));
}

}  // namespace

void write_page(const Page& page, const std::filesystem::path& file) {
  const std::string title = "Gases of inelastic hard spheres";
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n"
      "<p>Drawn by haff {2}. Lengths in diameters σ, energies in E(0), the energy per particle at "
      "the start; τ counts collisions suffered per particle.</p>\n",
      title, style, xml_escaped(code_version()));
  if (!page.agreement.empty()) text += agreement_text(page.agreement);
  if (!page.paper.empty())
    text += fmt::format("<h2>The paper's figures</h2>\n<p>As in {}.</p>\n",
                        xml_escaped(published_source)) +
            figures_text(page.paper);
  if (!page.paper.empty() && !page.lacking.empty())
    text += "<p class=\"absent\">Not drawn, since the store has no finished jobs for them: " +
            list_text(page.lacking) + ".</p>\n";
  if (!page.gases.empty())
    text +=
        "<h2>All gases of this store</h2>\n<p>A curve for each gas, the mean over its "
        "realizations. <code>campaign plot</code> draws any other question.</p>\n" +
        figures_text(page.gases);
  if (!page.from_before.empty())
    text += "<p class=\"absent\">In this folder from an earlier run, and not of this store: " +
            list_text(page.from_before) + ".</p>\n";
  write_file(file, text + "</body>\n</html>\n");
}

}  // namespace haff::campaign
