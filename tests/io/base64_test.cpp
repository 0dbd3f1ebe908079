// Bytes as base64, by the examples of RFC 4648, §10.
#include "io/base64.h"

#include <gtest/gtest.h>

namespace hexweft::detail {
namespace {

struct Example {
  std::string bytes, text;
};
const Example kExamples[] = {{"", ""},
                             {"f", "Zg=="},
                             {"fo", "Zm8="},
                             {"foo", "Zm9v"},
                             {"foob", "Zm9vYg=="},
                             {"fooba", "Zm9vYmE="},
                             {"foobar", "Zm9vYmFy"},
                             {std::string("\0\xff\xfe", 3), "AP/+"}};

TEST(Base64, IsWrittenAndRead) {
  for (const Example& example : kExamples) {
    std::string text, bytes;
    append_base64(text, example.bytes);
    EXPECT_EQ(text, example.text);
    EXPECT_TRUE(Base64Reader(text).read(example.bytes.size(), bytes));
    EXPECT_EQ(bytes, example.bytes);
  }
}

TEST(Base64, IsReadPieceByPieceAcrossBlanksAndPadding) {
  Base64Reader in(" Zm9v\n Yg= =\tZm9 vYmE=<");
  std::string bytes;
  EXPECT_TRUE(in.read(2, bytes) && in.read(0, bytes) && in.read(3, bytes));
  EXPECT_EQ(bytes, "foobf");
  EXPECT_TRUE(in.read(4, bytes));
  EXPECT_EQ(bytes, "foobfooba");
  EXPECT_EQ(in.rest(), "<");
}

TEST(Base64, EndsAtWhatIsNone) {
  for (const std::string text : {"Zm9v", "Zm9vY", "Zm9vYg=", "Zm9vY===", "Zm9v=mFy", "Zm9vYm-y",
                                 "Zm9vYg=A", "Zm9v\x80mFy"}) {
    Base64Reader in(text);
    std::string bytes;
    EXPECT_FALSE(in.read(std::size_t{1} << 60, bytes)) << text;
    EXPECT_EQ(bytes, "foo") << text;
    EXPECT_EQ(in.rest(), text.substr(4));
  }
}

}  // namespace
}  // namespace hexweft::detail
