// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <type_traits>
#include <variant>

#include "runner/figures_curves.hpp"
#include "runner/figures_pictures.hpp"

namespace etendue::validation {

namespace {

struct Section {
  const char* id;
  const char* link;
  const char* title;
  bool (*holds)(const Figure& figure);
};

template <class... Kinds>
bool is_any(const Figure& figure) {
  return (std::holds_alternative<Kinds>(figure) || ...);
}

constexpr std::array kSections = {
    Section{"curves", "Convergence", "How do errors fall, and how are they spread?",
            is_any<Convergence, ErrorHistogram, WorstInput>},
    Section{"form-factors", "Form factors", "Do form factors close and agree?", is_any<FactorTable>},
    Section{"radiosity", "Radiosity", "What does a solved room look like?", is_any<RadiosityField>},
    Section{"images", "Images", "Where do pictures differ?", is_any<ImagePair>}};

bool any(const Section& section, const std::vector<Exhibit>& exhibits) {
  for (const Exhibit& shown : exhibits) {
    if (section.holds(shown.figure)) return true;
  }
  return false;
}

const std::string& title_of(const Exhibit& shown) {
  return std::visit(
      [](const auto& figure) -> const std::string& {
        if constexpr (std::is_same_v<std::decay_t<decltype(figure)>, ErrorHistogram>)
          return figure.title();
        else
          return figure.title;
      },
      shown.figure);
}

std::string inner_html(const Exhibit& shown) {
  return std::visit(
      [](const auto& figure) {
        using Kind = std::decay_t<decltype(figure)>;
        if constexpr (is_curve<Kind>)
          return curve_html(figure);
        else
          return picture_html(figure);
      },
      shown.figure);
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '"')
      safe += "&quot;";
    else
      safe += c;
  }
  return safe;
}

std::string figures_links(const std::vector<Exhibit>& exhibits) {
  std::string html;
  for (const Section& section : kSections) {
    if (any(section, exhibits))
      html += std::string("<li><a href=\"#") + section.id + "\">" + section.link + "</a></li>";
  }
  return html;
}

std::string figures_of(const std::string& test, const std::vector<Exhibit>& exhibits) {
  std::string html;
  for (std::size_t k = 0; k < exhibits.size(); ++k) {
    if (exhibits[k].test == test)
      html += "<br><a href=\"#figure-" + std::to_string(k) + "\">" + escaped(title_of(exhibits[k])) + "</a>";
  }
  return html;
}

std::string figures_html(const std::vector<Exhibit>& exhibits) {
  std::string html;
  for (const Section& section : kSections) {
    if (!any(section, exhibits)) continue;
    const std::string id = section.id;
    html += "<section id=\"" + id + "\" aria-labelledby=\"" + id + "-title\"><h2 id=\"" + id + "-title\">" +
            section.title + "</h2>\n<div class=\"figures\">\n";
    for (std::size_t k = 0; k < exhibits.size(); ++k) {
      if (!section.holds(exhibits[k].figure)) continue;
      const std::string name = "figure-" + std::to_string(k);
      html += "<article class=\"figure\" id=\"" + name + "\" aria-labelledby=\"" + name + "-title\"><h3 id=\"" + name +
              "-title\">" + escaped(title_of(exhibits[k])) + "</h3><p class=\"note\"><code>" +
              escaped(exhibits[k].test) + "</code></p>" + inner_html(exhibits[k]) + "</article>\n";
    }
    html += "</div></section>\n";
  }
  return html;
}

}  // namespace etendue::validation
