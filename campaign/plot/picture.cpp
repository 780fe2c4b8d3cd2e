// SPDX-License-Identifier: GPL-3.0-or-later

#include "campaign/plot/picture.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "campaign/base/output/write_file.hpp"
#include "campaign/base/text/printable.hpp"
#include "campaign/plot/gnuplot.hpp"

namespace haff::campaign {
namespace {

using namespace std::string_view_literals;

// What a whole picture begins and ends with: the signature and the chunk IEND of PNG (ISO 15948),
// the declaration and the last tag of an SVG.
constexpr std::string_view png_begin = "\x89PNG\r\n\x1a\n"sv;
constexpr std::string_view png_end = "\0\0\0\0IEND\xae\x42\x60\x82"sv;
constexpr std::string_view svg_begin = "<?xml"sv, svg_end = "</svg>"sv;

bool is_whole(std::string_view picture, PictureFormat format) {
  if (format == PictureFormat::png)
    return picture.starts_with(png_begin) && picture.ends_with(png_end);
  picture = picture.substr(0, picture.find_last_not_of(" \n") + 1);
  return picture.starts_with(svg_begin) && picture.ends_with(svg_end);
}

// Completes the SVG of gnuplot: keeps blanks next to a change of font, which some viewers drop, and
// makes the caption the picture's title. The page shows the caption as text, so that its place
// below the axes is cut off.
std::string finished(std::string svg, const Plot& plot) {
  const auto replace = [&](std::string_view old, const std::string& now) {
    const auto place = svg.find(old);
    if (place != std::string::npos) svg.replace(place, old.size(), now);
  };
  replace("<svg ", "<svg xml:space=\"preserve\" ");
  const std::string size = fmt::format("width=\"{}\" height=\"{}\"", plot.width, plot.height);
  const std::string view = fmt::format("viewBox=\"0 0 {} {}\"", plot.width, plot.height);
  const int height = static_cast<int>(std::lround(plot.height * (1 - caption_share(plot))));
  replace(size, fmt::format("width=\"{}\" height=\"{}\"", plot.width, height));
  replace(view, fmt::format("viewBox=\"0 0 {} {}\"", plot.width, height));
  replace("<title>Gnuplot</title>", "<title>" + xml_escaped(plot.caption) + "</title>");
  return svg;
}

}  // namespace

void draw_picture(const Plot& plot, const std::filesystem::path& file, PictureFormat format) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);  // an older one must not pass for this one
  std::string picture = run_gnuplot(gnuplot_script(plot, format));
  if (!is_whole(picture, format))
    throw std::runtime_error(picture.empty()
                                 ? "gnuplot has drawn nothing"
                                 : "gnuplot's picture is cut off; is the temporary folder full?");
  if (format == PictureFormat::svg) picture = finished(std::move(picture), plot);
  write_file(file, picture);
}

void draw_both(const Plot& plot, const std::filesystem::path& stem, OutputFiles& files) {
  for (const auto& [ending, format] :
       {std::pair{".svg", PictureFormat::svg}, std::pair{".png", PictureFormat::png}})
    files.attempt(stem.string() + ending, [&, format = format](const std::filesystem::path& file) {
      draw_picture(plot, file, format);
    });
}

}  // namespace haff::campaign
