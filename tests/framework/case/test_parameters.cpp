#include "mesogen/plugin/parameters.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesogen/diagnostics/error.hpp"

namespace mesogen {
namespace {

TEST(Parameters, DescribeThemselves) {
  double number = 0.1;
  std::optional<double> step;
  std::int64_t count = 3;
  bool flag = false;
  std::string text = "a \"b\"";
  std::vector<double> numbers = {1.0, 2.5};
  std::vector<std::string> texts = {"x", "y"};
  Parameter::Rows rows = {{1.0, 0.5}, {2.0, 1e-300}};
  ParameterList list;
  const auto told = [](const Parameter& p) { return p.type_text() + " | " + p.range_text() + " | " + p.value_text(); };
  EXPECT_EQ(told(list.number("n1", number).above(0.0)), "number | > 0 | 0.1");
  EXPECT_EQ(told(list.number("n2", number).at_least(0.0).at_most(1.5)), "number | 0 to 1.5 | 0.1");
  EXPECT_EQ(told(list.number("n3", number).at_least(-1.0).below(1.0)), "number | >= -1 and < 1 | 0.1");
  EXPECT_EQ(told(list.number("n4", number).at_most(7.0)), "number | <= 7 | 0.1");
  EXPECT_EQ(told(list.number_or("s5", step, "auto")), "number or \"auto\" |  | \"auto\"");
  EXPECT_EQ(told(list.number_or("s6", step, "")), "number |  | ");
  step = 4.0;
  EXPECT_EQ(told(list.number_or("s7", step, "auto")), "number or \"auto\" |  | 4.0");
  EXPECT_EQ(told(list.integer("c8", count).at_least(1)), "integer | >= 1 | 3");
  EXPECT_EQ(told(list.flag("f9", flag)), "true or false |  | false");
  EXPECT_EQ(told(list.text("t10", text).choices({"p", "q"})), "text | one of: p, q | \"a \\\"b\\\"\"");
  EXPECT_EQ(told(list.numbers("l11", numbers).sizes({2, 3})), "list of 2 or 3 numbers |  | [1.0, 2.5]");
  EXPECT_EQ(told(list.texts("l12", texts)), "list of texts |  | [\"x\", \"y\"]");
  EXPECT_EQ(told(list.rows("r13", rows).sizes({2})), "list of lists of 2 numbers |  | [[1.0, 0.5], [2.0, 1e-300]]");
  number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(list.number("n14", number).value_text(), "");
}

TEST(Parameters, KeepTheirOrderAndTexts) {
  double a = 1.0;
  double b = 2.0;
  ParameterList list;
  list.number("z", a).unit("m").doc("first").required();
  list.number("a.b", b);
  ASSERT_EQ(list.all().size(), 2U);
  EXPECT_EQ(list.all()[0].name, "z");
  EXPECT_EQ(list.all()[0].unit_text, "m");
  EXPECT_EQ(list.all()[0].doc_text, "first");
  EXPECT_TRUE(list.all()[0].is_required);
  EXPECT_EQ(list.all()[1].name, "a.b");
  EXPECT_EQ(list.all()[1].unit_text, "1");
}

TEST(Parameters, AreDeclaredOnce) {
  double a = 1.0;
  double b = 2.0;
  ParameterList list;
  const auto told = [&](const std::string& name) {
    try {
      list.number(name, b);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::plugin_refused);
      return std::string(error.what());
    }
    return std::string("no error");
  };
  list.number("bulk.A", a);
  EXPECT_EQ(told("bulk.A"), "declares the parameter \"bulk.A\" twice");
  EXPECT_EQ(told("bulk"),
            "declares the parameters \"bulk.A\" and \"bulk\", of which one is a table that holds the other");
  EXPECT_EQ(told("bulk.A.x"),
            "declares the parameters \"bulk.A\" and \"bulk.A.x\", of which one is a table that holds the other");
  EXPECT_EQ(told("bulk.Al"), "no error");
  EXPECT_EQ(told("bul"), "no error");
}

}  // namespace
}  // namespace mesogen
