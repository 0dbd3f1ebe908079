#include "io/vtu_values.h"

#include <limits>
#include <zlib.h>

#include "io/base64.h"

namespace hexweft::detail {
namespace {

// The bytes of one array: what is in the file, without their encoding and compression.
class BinaryReader {
 public:
  BinaryReader(const VtuDocument& document, const VtkBlock& block, const TextScanner& in,
               std::string_view data, bool is_base64)
      : document_(document), block_(block), in_(in), raw_(data), is_base64_(is_base64) {}

  /// The bytes, which must be `size` in number.
  std::string read(std::size_t size) {
    if (document_.compressor() == "vtkZLibDataCompressor") return read_compressed(size);
    if (!document_.compressor().empty()) {
      fail("expected data compressed by vtkZLibDataCompressor or not at all, found " +
           quoted(document_.compressor()));
    }
    if (const std::size_t found = read_words(1)[0]; found != size) fail_size(size, found);
    return take(size);
  }

 private:
  std::string read_compressed(std::size_t size);
  std::vector<std::int64_t> read_words(std::size_t n);
  std::string take(std::size_t n);
  void inflate(const std::string& packed, std::size_t size, std::string& out) const;

  [[noreturn]] void fail(const std::string& problem) const {
    in_.fail(block_.header, block_.title + ": " + problem);
  }
  [[noreturn]] void fail_size(std::size_t expected, std::size_t found) const {
    fail("expected " + std::to_string(expected) + " bytes, found " + std::to_string(found) +
         " announced");
  }

  const VtuDocument& document_;
  const VtkBlock& block_;
  const TextScanner& in_;
  std::string_view raw_;  // what has not been read, if it is no base64
  Base64Reader base64_{raw_};
  bool is_base64_;
};

std::string BinaryReader::read_compressed(std::size_t size) {
  const std::vector<std::int64_t> header = read_words(3);
  const std::size_t n_blocks = header[0], block_size = header[1], last = header[2];
  const std::size_t n_full = n_blocks - (last > 0 && n_blocks > 0 ? 1 : 0);
  const bool fits =
      n_blocks > 0 && (n_full == 0 || (block_size > 0 && block_size <= size / n_full));
  if (!fits || n_full * block_size + last != size) {
    fail("expected blocks of " + std::to_string(size) + " bytes in all, found " +
         std::to_string(n_blocks) + " blocks of " + std::to_string(block_size) + ", the last of " +
         std::to_string(last > 0 ? last : block_size));
  }
  const std::vector<std::int64_t> packed_sizes = read_words(n_blocks);
  std::string bytes;
  for (std::size_t i = 0; i < n_blocks; ++i) {
    inflate(take(packed_sizes[i]), i < n_full ? block_size : last, bytes);
  }
  return bytes;
}

// Words of the header: they must be there before there is memory for them.
std::vector<std::int64_t> BinaryReader::read_words(std::size_t n) {
  const std::string bytes = take(document_.header_type().bytes_of(n));
  return decode_vtk_values(in_, block_, document_.header_type(), n, bytes.data(),
                           document_.byte_order())
      .integers;
}

std::string BinaryReader::take(std::size_t n) {
  std::string bytes;
  if (!is_base64_) {
    bytes = raw_.substr(0, n);
    raw_.remove_prefix(bytes.size());
  } else if (!base64_.read(n, bytes)) {
    TextScanner rest(base64_.rest(), "");
    if (!rest.at_end()) {
      fail("expected " + std::to_string(n) + " bytes as base64, found " + quoted(rest.peek()));
    }
  }
  if (bytes.size() < n) {
    fail("expected " + std::to_string(n) + " bytes, found " + std::to_string(bytes.size()) +
         " to the end of the data");
  }
  return bytes;
}

void BinaryReader::inflate(const std::string& packed, std::size_t size, std::string& out) const {
  constexpr std::size_t kHighestRatio = 1032;  // that zlib's compression attains
  uLongf found = size;
  if (packed.size() >= size / kHighestRatio) {  // a lying size must not cost memory
    const std::size_t begin = out.size();
    out.resize(begin + size);
    const int status = uncompress(reinterpret_cast<Bytef*>(out.data() + begin), &found,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (status == Z_OK && found == size) return;
  }
  fail("expected a block of " + std::to_string(size) + " bytes compressed by zlib, found " +
       std::to_string(packed.size()) + " bytes that are none");
}

std::string_view appended_data(const VtuDocument& document, pugi::xml_node element,
                               const std::string& title) {
  if (!document.appended()) {
    document.fail(element, title + ": expected <AppendedData> in the file, found none");
  }
  const std::int64_t most = static_cast<std::int64_t>(document.appended()->size());
  return document.appended()->substr(document.integer(element, "offset", 0, most));
}

DataArray read_ascii(TextScanner& in, const VtkBlock& block, const VtkType& type,
                     std::size_t count) {
  DataArray array = read_vtk_values(in, block, type, count);
  if (!in.at_end()) {
    in.fail_expected("the end of " + block.title + " after " + std::to_string(count) + " numbers");
  }
  return array;
}

}  // namespace

VtuValues read_vtu_values(const VtuDocument& document, pugi::xml_node element,
                          const std::string& title, const VtkType& type, std::size_t count) {
  const bool has_offset = !element.attribute("offset").empty();
  const std::string_view format =
      element.attribute("format").as_string(has_offset ? "appended" : "ascii");
  const bool is_ascii = format == "ascii", is_appended = format == "appended";
  if (!is_ascii && !is_appended && format != "binary") {
    document.fail(element, title + ": expected a format of ascii, binary or appended, found " +
                               quoted(format));
  }
  TextScanner in = document.text_of(element);
  const VtkBlock block{title, document.offset_of(element), in.offset(), !is_ascii};
  if (is_ascii) return {block, read_ascii(in, block, type, count)};
  const std::string_view data =
      is_appended ? appended_data(document, element, title) : in.text().substr(in.offset());
  std::string bytes;
  if (count > 0) {  // writers differ in what they put where there is nothing
    bytes = BinaryReader(document, block, in, data, !is_appended || document.appended_is_base64())
                .read(type.bytes_of(count));
  }
  return {block, decode_vtk_values(in, block, type, count, bytes.data(), document.byte_order())};
}

}  // namespace hexweft::detail
