// SPDX-License-Identifier: BSD-3-Clause
#include "Report/Page/ReportPage.h"

#include "Report/Page/Html.h"
#include "ReportPageText.h"

#include <cmath>
#include <cstdio>
#include <optional>

namespace freespace
{

namespace
{

std::string Formatted(const char* format, double value)
{
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string Image(const ReportPicture& picture)
{
  return "<img src=\"" + EscapeHtml(picture.picture.uri) + "\" width=\"" +
    std::to_string(picture.picture.width) + "\" height=\"" +
    std::to_string(picture.picture.height) + "\" alt=\"" + EscapeHtml(picture.alt) + "\">";
}

std::string Images(const std::vector<ReportPicture>& pictures)
{
  std::string html = "<div class=\"" + std::string(pictures.size() > 1 ? "pair" : "single") + "\">";
  for (const ReportPicture& picture : pictures)
  {
    html += Image(picture);
  }
  return html + "</div>";
}

std::string Facts(const std::vector<ReportFact>& facts)
{
  std::string html = "<dl class=\"facts\">\n";
  for (const ReportFact& fact : facts)
  {
    html +=
      "<div><dt>" + EscapeHtml(fact.label) + "</dt><dd>" + EscapeHtml(fact.value) + "</dd></div>\n";
  }
  return html + "</dl>";
}

std::string Views(const std::vector<ReportView>& views)
{
  std::string html = "<div class=\"views\">\n";
  for (const ReportView& view : views)
  {
    html += "<figure class=\"view\"><div class=\"pair\">" + Image(view.photograph) +
      Image(view.features) + "</div><figcaption><b>" + EscapeHtml(view.name) + "</b> " +
      EscapeHtml(view.caption) + "</figcaption></figure>\n";
  }
  return html + "</div>";
}

std::string Row(const std::vector<std::string>& cells, bool isHead)
{
  std::string html = "<tr>";
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const std::string text = EscapeHtml(cells[i]);
    html += isHead ? "<th scope=\"col\">" + text + "</th>"
      : i == 0     ? "<th scope=\"row\">" + text + "</th>"
                   : "<td>" + text + "</td>";
  }
  return html + "</tr>\n";
}

std::string Table(const ReportTable& table)
{
  std::string html = "<div class=\"table\"><table>\n<caption>" + EscapeHtml(table.caption) +
    "</caption>\n<thead>" + Row(table.columns, true) + "</thead>\n<tbody>\n";
  const std::size_t body = table.rows.size() - (table.totalLast && !table.rows.empty() ? 1 : 0);
  for (std::size_t i = 0; i < body; ++i)
  {
    html += Row(table.rows[i], false);
  }
  html += "</tbody>\n";
  if (body < table.rows.size())
  {
    html += "<tfoot>" + Row(table.rows.back(), false) + "</tfoot>\n";
  }
  html += "</table></div>\n";
  for (const std::string& note : table.notes)
  {
    html += "<p class=\"note\">" + EscapeHtml(note) + "</p>\n";
  }
  return html;
}

std::string Tables(const std::vector<ReportTable>& tables)
{
  std::string html;
  for (const ReportTable& table : tables)
  {
    html += Table(table);
  }
  return html;
}

std::string TruthSection(const std::optional<ReportTable>& truth)
{
  if (!truth)
  {
    return "";
  }
  return "<section id=\"truth\">\n<h2>Against the truth</h2>\n" + Table(*truth) + "</section>\n";
}

std::string Commands(const std::vector<ReportCommand>& commands)
{
  std::string html;
  for (const ReportCommand& command : commands)
  {
    html += "<p>" + EscapeHtml(command.what) + "</p>\n<pre tabindex=\"0\"><code>" +
      EscapeHtml(command.line) + "</code></pre>\n";
  }
  return html;
}

// Within a script element only "</script" and "<!--" end it: JSON may write < otherwise.
std::string ForScript(const std::string& json)
{
  std::string safe;
  safe.reserve(json.size());
  for (const char c : json)
  {
    safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return safe;
}

}

std::string WriteReportPage(const Report& report)
{
  return FillTemplate(PageTemplate,
    { { "style", PageStyle }, { "viewer", SurfaceViewerScript },
      { "title", EscapeHtml(report.title) }, { "summary", EscapeHtml(report.summary) },
      { "facts", Facts(report.facts) }, { "model", ForScript(report.model) },
      { "model-caption", EscapeHtml(report.modelCaption) }, { "views", Views(report.views) },
      { "views-caption", EscapeHtml(report.viewsCaption) }, { "cameras", report.cameras },
      { "cameras-caption", EscapeHtml(report.camerasCaption) },
      { "features", Images(report.features) }, { "surface", Images(report.surface) },
      { "textured", Images(report.textured) }, { "numbers", Tables(report.numbers) },
      { "truth", TruthSection(report.truth) },
      { "truth-link", report.truth ? "<a href=\"#truth\">Truth</a>" : "" },
      { "commands", Commands(report.commands) }, { "footer", EscapeHtml(report.footer) } });
}

std::string FormatCount(long long count)
{
  std::string digits = std::to_string(count);
  const int first = count < 0 ? 1 : 0;
  for (int at = static_cast<int>(digits.size()) - 3; at > first; at -= 3)
  {
    digits.insert(at, ",");
  }
  return digits;
}

std::string FormatNumber(double value)
{
  if (value == 0 || !std::isfinite(value))
  {
    return value == 0 ? "0" : "–";
  }
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", std::min(std::max(3 - before, 0), 12), value);
  return text;
}

std::string FormatShare(double share)
{
  return std::isfinite(share) ? Formatted("%.1f %%", 100 * share) : "–";
}

std::string FormatSeconds(double seconds)
{
  if (seconds >= 100)
  {
    const long whole = std::lround(seconds);
    return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  }
  return Formatted(seconds < 9.95 ? "%.2f s" : "%.1f s", seconds);
}

}
