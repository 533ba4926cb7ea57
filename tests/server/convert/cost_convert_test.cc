// The table of costs (core/ocp/cost_table.h) and rollgait.v1.CostTerm say the same.
#include "server/convert/cost_convert.h"

#include <gmock/gmock.h>
#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

namespace rollgait::server {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::util::MessageDifferencer;

const google::protobuf::OneofDescriptor& Terms() { return *v1::CostTerm::descriptor()->FindOneofByName("term"); }

// Sets every field of a term's message to values that tell them apart.
void Fill(Message* message) {
  const google::protobuf::Reflection& fields = *message->GetReflection();
  for (int i = 0; i < message->GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = message->GetDescriptor()->field(i);
    if (field->is_map()) {
      Message* entry = fields.AddMessage(message, field);
      entry->GetReflection()->SetString(entry, entry->GetDescriptor()->FindFieldByName("key"), "hip_l");
      entry->GetReflection()->SetDouble(entry, entry->GetDescriptor()->FindFieldByName("value"), 0.5);
    } else if (field->is_repeated() && field->cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      Fill(fields.AddMessage(message, field));
    } else if (field->is_repeated()) {
      fields.AddDouble(message, field, 0.25);
    } else if (field->cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
      fields.SetString(message, field, "hip_l");
    } else {
      fields.SetDouble(message, field, 3 + i);
    }
  }
}

TEST(CostConvert, TheTableHasTheFieldsOfTheProto) {
  std::set<std::string> of_table, of_proto;
  ForEachCost([&of_table](const auto& row) { of_table.insert(row.traits.field); });
  for (int i = 0; i < Terms().field_count(); ++i) of_proto.insert(Terms().field(i)->name());
  EXPECT_EQ(of_table, of_proto);
}

// With every field set: a field of a message that its row leaves out does not come back.
TEST(CostConvert, EveryTermComesBackAsItWas) {
  for (int i = 0; i < Terms().field_count(); ++i) {
    for (const bool full : {false, true}) {
      v1::CostTerm cost;
      Message* term = cost.GetReflection()->MutableMessage(&cost, Terms().field(i));
      if (full) {
        Fill(term);
        cost.set_weight(0.125);
      }
      Violations violations;
      const GaitRequest::CostTerm decoded = DecodeCost("cost", cost, &violations);
      EXPECT_EQ(TraitsOf(decoded.term).field, Terms().field(i)->name());
      EXPECT_TRUE(MessageDifferencer::Equals(EncodeCost(decoded), cost)) << cost.DebugString();
      EXPECT_TRUE(violations.empty());
    }
  }
}

// The text of solve_spec.proto on a term, from its comment to the end of its message.
std::string TextOf(const std::string& message) {
  std::ifstream file(ROLLGAIT_SOLVE_SPEC);
  const std::string all((std::istreambuf_iterator<char>(file)), {});
  const size_t name = all.find("\n  message " + message + " {");
  if (name == std::string::npos) return "";
  const size_t before = all.rfind("}\n", name), inner = all.find("\n", name + 1);
  const bool empty = all.compare(inner - 2, 2, "{}") == 0;
  return all.substr(before, (empty ? inner : all.find("\n  }\n", name)) - before);
}

// A number as the proto writes it.
std::string Text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

// The reference is made from the comments of the proto: they state what the rows say.
TEST(CostConvert, TheProtoStatesUnitsRangesAndDefaultsOfTheTable) {
  ForEachCost([]<typename Term>(const CostRow<Term>& row) {
    const std::string text =
        TextOf(Terms().containing_type()->FindFieldByName(row.traits.field)->message_type()->name());
    EXPECT_THAT(text, testing::ContainsRegex(" dt, " + std::string(row.traits.unit) + "[ .:,]")) << row.traits.field;
    row.ForEachParameter([&](const CostParameter<Term>& parameter) {
      EXPECT_THAT(text, testing::HasSubstr(" " + std::string(parameter.field) + " = "));
      if (text.find("// As MechanicalWork." + std::string(parameter.field)) != std::string::npos) return;
      EXPECT_THAT(text, testing::HasSubstr("[" + Text(parameter.min) + ", " + Text(parameter.max) + "]"));
      EXPECT_THAT(text, testing::ContainsRegex("Defaults? (.* and )?" + Text(parameter.fallback))) << parameter.field;
    });
  });
}

TEST(CostConvert, ATermThatIsNotSetIsAViolation) {
  Violations violations;
  DecodeCost("costs[2]", v1::CostTerm(), &violations);
  ASSERT_EQ(violations.size(), 1u);
  EXPECT_EQ(violations[0].field, "costs[2]");
}

}  // namespace
}  // namespace rollgait::server
