// SPDX-License-Identifier: Apache-2.0
#include "etendue/raytracing/ray_tree_drawing.hpp"

#include <algorithm>

#include "etendue/text/number_text.hpp"
#include "etendue/text/utf8.hpp"

namespace etendue {

namespace {

constexpr double kLetter = 7.5;  // width of a letter of the 12-pixel font, at most
constexpr double kLevel = 96;    // between two levels, in pixels
constexpr double kTop = 36;      // of the eye
constexpr double kRadius = 7;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// Letters that a text takes: bytes that continue none.
double letters(const std::string& text) {
  return static_cast<double>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string end_label(const RayNode& node, const Scene& scene) {
  switch (node.end) {
    case RayEnd::surface: {
      const std::string& name = scene.objects[node.hit->object].name;
      return name.empty() ? "object " + std::to_string(node.hit->object) : printable(name);
    }
    case RayEnd::left_scene:
      return "leaves";
    case RayEnd::depth_limit:
      return "depth limit";
    case RayEnd::below_cutoff:
      return "below cutoff";
    case RayEnd::environment:
      return "environment";
  }
  return "unknown";
}

struct Point {
  double x, y;
};

std::string number(double value) {
  return rounded(value, 6);
}

std::string text_at(const Point& at, const std::string& words, const char* anchor) {
  return "<text x=\"" + number(at.x) + "\" y=\"" + number(at.y) + "\" text-anchor=\"" + anchor + "\">" +
         escaped(words) + "</text>\n";
}

}  // namespace

TreeLayout layout(const RayTree& tree) {
  const std::size_t count = tree.nodes.size();
  std::vector<double> first(count, -1), last(count, -1);  // columns of the first and the last ray that it causes
  TreeLayout result;
  result.across.assign(count, 0);
  std::vector<bool> causes(count, false);
  for (const RayNode& node : tree.nodes) {
    if (node.parent != RayNode::kNone) causes[node.parent] = true;
    result.levels = std::max(result.levels, node.level + 1);
  }
  // A parent stands right before its first descendant, so columns go by the tree's order.
  double next = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!causes[i]) result.across[i] = next++;
  }
  for (std::size_t i = count; i-- > 0;) {
    if (causes[i]) result.across[i] = (first[i] + last[i]) / 2;
    const std::size_t parent = tree.nodes[i].parent;
    if (parent == RayNode::kNone) continue;
    first[parent] = result.across[i];
    if (last[parent] < 0) last[parent] = result.across[i];
  }
  result.columns = std::max(next, 1.0);
  return result;
}

std::string to_svg(const RayTree& tree, const Scene& scene) {
  const TreeLayout places = layout(tree);
  const auto names = ray_names(tree);
  double widest = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    widest = std::max({widest, letters(end_label(tree.nodes[i], scene)), 2 * letters(names[i]) + 14});
  }
  const double column = kLetter * (widest + 2);
  const auto at = [&](std::size_t i) {
    return Point{column * (places.across[i] + 0.5), kTop + kLevel * (tree.nodes[i].level + 1)};
  };
  const double width = column * places.columns, height = kTop + kLevel * places.levels + 40;
  std::string svg =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" + number(height) +
      "\" viewBox=\"0 0 " + number(width) + " " + number(height) +
      "\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  // Words stand on a white edge, over all lines.
  svg += "<style>text { paint-order: stroke; stroke: white; stroke-width: 4px }</style>\n";
  const Point eye{at(0).x, kTop};
  std::string words = text_at({eye.x, eye.y - 10}, "eye", "middle");
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const RayNode& node = tree.nodes[i];
    const Point from = node.parent == RayNode::kNone ? eye : at(node.parent), to = at(i);
    const bool dashed = node.kind == RayKind::transmitted;
    svg += "<line x1=\"" + number(from.x) + "\" y1=\"" + number(from.y) + "\" x2=\"" + number(to.x) + "\" y2=\"" +
           number(to.y) + "\" stroke=\"#444\"" + (dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
    if (node.end == RayEnd::surface) {
      svg += "<circle cx=\"" + number(to.x) + "\" cy=\"" + number(to.y) + "\" r=\"" + number(kRadius) +
             "\" fill=\"#9cf\" stroke=\"#444\"/>\n";
    }
    // two thirds down, so that the labels of siblings stand apart
    const Point label{from.x + 0.66 * (to.x - from.x) + 4, from.y + 0.66 * (to.y - from.y)};
    words += text_at(label, names[i] + " " + rounded(node.weight, 4), "start");
    words += text_at({to.x, to.y + kRadius + 14}, end_label(node, scene), "middle");
  }
  return svg + words + "</svg>\n";
}

}  // namespace etendue
