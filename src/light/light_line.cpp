#include "light/light_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace illum {
namespace {

constexpr std::size_t kMaxLineBytes = 4096;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
bool isDelimiter(char c) {
  return c == ',' || c == ';';
}
bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

std::string_view withoutTrailing(std::string_view text, bool (*unwanted)(char)) {
  while (!text.empty() && unwanted(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  return withoutTrailing(text, isBlank);
}

/// What sets the fields of a line apart.
enum class Split {
  DecimalComma,  ///< blanks and semicolons; commas are decimal marks
  Delimiters,    ///< commas and semicolons; a field may hold blanks
  Any,
};

bool ends(char c, Split split) {
  switch (split) {
    case Split::DecimalComma:
      return isBlank(c) || c == ';';
    case Split::Delimiters:
      return isDelimiter(c);
    case Split::Any:
      break;
  }
  return isBlank(c) || isDelimiter(c);
}

struct Field {
  std::string_view text;  ///< quotes included
  bool quoted = false;
  std::optional<double> number;
};

/// Independent of the locale. A number out of range counts as infinite, so that it is refused with
/// the others that are.
std::optional<double> numberIn(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  // As the C library of older Windows prints what is not finite: 1.#INF, -1.#IND, 1.#QNAN.
  if (text.size() > 3 && isDigit(text[text.front() == '-']) && text.find(".#") != text.npos)
    return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (rest != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  return value;
}

/// "0,5" as 0.5: one comma between digits and no point.
std::optional<double> numberWithCommaIn(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == text.npos) return std::nullopt;
  const bool between =
      comma > 0 && comma + 1 < text.size() && isDigit(text[comma - 1]) && isDigit(text[comma + 1]);
  if (!between || text.find('.') != text.npos) return std::nullopt;
  std::string withPoint(text);
  withPoint[comma] = '.';
  return numberIn(withPoint);
}

/// Cuts a line into fields, in time proportional to its length.
class Fields {
 public:
  Fields(std::string_view line, Split split) : line_(line), split_(split) {
    while (valid_ && position_ < line_.size()) takeField();
  }

  bool valid() const { return valid_; }  ///< no field is empty
  bool decimalCommas() const { return decimalCommas_; }
  const std::vector<Field>& all() const { return fields_; }

 private:
  void skipBlanks() {
    while (position_ < line_.size() && isBlank(line_[position_])) ++position_;
  }

  void takeField() {
    skipBlanks();
    const std::size_t start = position_;
    if (start == line_.size()) return;
    Field field;
    if (const std::size_t past = pastQuoted(start); past != start) {
      position_ = past;
      field.quoted = true;
    } else {
      while (position_ < line_.size() && !ends(line_[position_], split_)) ++position_;
    }
    field.text = trimmed(line_.substr(start, position_ - start));
    if (!field.quoted) field.number = number(field.text);
    valid_ = !field.text.empty();
    fields_.push_back(field);
    skipBlanks();
    if (position_ < line_.size() && isDelimiter(line_[position_]) && ends(line_[position_], split_))
      ++position_;
  }

  std::optional<double> number(std::string_view text) {
    if (split_ == Split::DecimalComma) {
      if (const auto value = numberWithCommaIn(text)) {
        decimalCommas_ = true;
        return value;
      }
    }
    return numberIn(text);
  }

  /// One past the closing quote of the quoted field at `start`, or `start` if there is none: then
  /// the quote is part of a name, and no other is looked for. A doubled quote stands for itself.
  std::size_t pastQuoted(std::size_t start) {
    const char quote = line_[start];
    if (unclosed_ || (quote != '"' && quote != '\'')) return start;
    for (std::size_t i = start + 1; i < line_.size(); ++i) {
      if (line_[i] != quote) continue;
      if (i + 1 < line_.size() && line_[i + 1] == quote) {
        ++i;
        continue;
      }
      if (i + 1 == line_.size() || isBlank(line_[i + 1]) || isDelimiter(line_[i + 1])) return i + 1;
    }
    unclosed_ = true;
    return start;
  }

  std::string_view line_;
  Split split_;
  std::size_t position_ = 0;
  bool valid_ = true, decimalCommas_ = false, unclosed_ = false;
  std::vector<Field> fields_;
};

std::string unquoted(std::string_view text) {
  const char quote = text.front();
  text = text.substr(1, text.size() - 2);
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    result += text[i];
    if (text[i] == quote) ++i;
  }
  return result;
}

/// Fields [first, last) with whatever stands between them.
std::string nameOf(const std::vector<Field>& fields, std::size_t first, std::size_t last) {
  if (last - first == 1 && fields[first].quoted) return unquoted(fields[first].text);
  const char* const begin = fields[first].text.data();
  const std::string_view end = fields[last - 1].text;
  return {begin, end.data() + end.size()};
}

NamedNumbers assemble(const Fields& fields, std::size_t firstNumber, std::size_t pastNumbers,
                      std::string name) {
  NamedNumbers result{std::move(name), {}, fields.decimalCommas()};
  for (std::size_t i = firstNumber; i < pastNumbers; ++i)
    result.numbers.push_back(*fields.all()[i].number);
  return result;
}

/// Which numbers of numbers a line may have, and whether it may do without a name.
struct Shape {
  std::initializer_list<std::size_t> counts;
  bool mayLackName;
  bool allows(std::size_t count) const {
    return std::find(counts.begin(), counts.end(), count) != counts.end();
  }
};

std::optional<NamedNumbers> readFields(const Fields& fields, const Shape& shape, Split split) {
  const std::vector<Field>& all = fields.all();
  const std::size_t size = all.size();
  std::size_t trailing = 0, leading = 0;
  while (trailing < size && all[size - 1 - trailing].number) ++trailing;
  while (leading < size && all[leading].number) ++leading;
  if (trailing == size) {
    if (shape.mayLackName && shape.allows(size)) return assemble(fields, 0, size, {});
    if (size < 2 || !shape.allows(size - 1)) return std::nullopt;
    return assemble(fields, 1, size, nameOf(all, 0, 1));
  }
  // Where delimiters stand, blanks belong to the name and it is one field; a running number before
  // it is nothing to us.
  const bool oneField = split == Split::Delimiters;
  if (shape.allows(trailing)) {
    const std::size_t names = size - trailing;
    if (!oneField || names == 1) return assemble(fields, names, size, nameOf(all, 0, names));
    if (names == 2 && leading == 1) return assemble(fields, 2, size, nameOf(all, 1, 2));
  }
  if (shape.allows(leading) && trailing == 0 && (!oneField || size - leading == 1))
    return assemble(fields, 0, leading, nameOf(all, leading, size));
  return std::nullopt;
}

std::optional<NamedNumbers> readComplete(std::string_view line, const Shape& shape) {
  for (const Split split : {Split::DecimalComma, Split::Delimiters, Split::Any}) {
    const Fields fields(line, split);
    if (!fields.valid() || (split == Split::DecimalComma && !fields.decimalCommas())) continue;
    if (auto result = readFields(fields, shape, split)) return result;
  }
  return std::nullopt;
}

bool beginsComment(std::string_view line, std::size_t i) {
  return isBlank(line[i - 1]) && (line[i] == '#' || line.substr(i, 2) == "//");
}

}  // namespace

LightLines::LightLines(std::string_view text, const std::filesystem::path& source)
    : rest_(text), source_(source) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  if (rest_.starts_with("\xFF\xFE") || rest_.starts_with("\xFE\xFF"))
    throw inputError(source, "a light file in UTF-8 or ASCII", "UTF-16");
  if (rest_.find('\0') != rest_.npos) throw inputError(source, "a text file", "binary data");
}

bool LightLines::next() {
  while (!rest_.empty()) {
    ++number_;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest_.size(), 1));
    if (line_.size() > kMaxLineBytes)
      throw error("lines of at most 4096 bytes", std::to_string(line_.size()) + " bytes");
    line_ = withoutTrailing(trimmed(line_), [](char c) { return isBlank(c) || isDelimiter(c); });
    if (!line_.empty() && !line_.starts_with('#') && !line_.starts_with("//")) return true;
  }
  return false;
}

Error LightLines::error(std::string_view expected, std::string_view found) const {
  return inputError(source_.string() + ":" + std::to_string(number_), expected, found);
}

Error LightLines::error(std::string_view expected) const {
  return error(expected, fmt::format("'{}'", shown(line_)));
}

std::optional<NamedNumbers> readNamedNumbers(std::string_view line,
                                             std::initializer_list<std::size_t> counts,
                                             bool mayLackName) {
  const Shape shape{counts, mayLackName};
  // A # may be part of a name; it begins a comment if the line is complete without it. Looking at
  // the first and the last one only bounds the work for hostile lines.
  std::size_t first = line.size(), last = line.size();
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (!beginsComment(line, i)) continue;
    first = std::min(first, i);
    last = i;
  }
  for (const std::size_t end : {first, last}) {
    if (end == line.size()) break;
    const auto tail = [](char c) { return isBlank(c) || isDelimiter(c); };
    if (auto result = readComplete(withoutTrailing(line.substr(0, end), tail), shape))
      return result;
  }
  return readComplete(line, shape);
}

bool hasNoNumbers(std::string_view line) {
  const Fields fields(line, Split::Any);
  return fields.valid() &&
         std::none_of(fields.all().begin(), fields.all().end(),
                      [](const Field& field) { return field.number.has_value(); });
}

LinearRgb intensityIn(std::span<const double> numbers, const LightLines& lines) {
  using Limits = std::numeric_limits<float>;
  for (const double number : numbers)
    if (!(number >= Limits::denorm_min() && number <= Limits::max()))
      throw lines.error("a positive, finite intensity", fmt::format("{}", number));
  const std::size_t step = numbers.size() == 1 ? 0 : 1;
  return {static_cast<float>(numbers[0]), static_cast<float>(numbers[step]),
          static_cast<float>(numbers[2 * step])};
}

std::string withoutFolders(std::string_view name) {
  const std::size_t slash = name.find_last_of("/\\");
  return std::string(trimmed(slash == name.npos ? name : name.substr(slash + 1)));
}

std::string shown(std::string_view text) {
  constexpr std::size_t kMaxShown = 60;
  std::size_t end = std::min(text.size(), kMaxShown);
  if (end < text.size())  // not within a character of UTF-8
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  std::string result(text.substr(0, end));
  for (char& c : result)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  if (end < text.size()) result += "…";
  return result;
}

}  // namespace illum
