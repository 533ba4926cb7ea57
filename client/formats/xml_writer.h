// XML text from nested elements; tinyxml2 escapes and indents it.
#ifndef ROLLGAIT_CLIENT_FORMATS_XML_WRITER_H_
#define ROLLGAIT_CLIENT_FORMATS_XML_WRITER_H_

#include <tinyxml2.h>

#include <string>
#include <utility>
#include <vector>

namespace rollgait::client {

class XmlWriter {
 public:
  using Attributes = std::vector<std::pair<std::string, std::string>>;

  XmlWriter();
  void Comment(const std::string& text);
  void Open(const std::string& element, const Attributes& attributes = {});
  void Close();
  // <element>text</element>
  void Leaf(const std::string& element, const std::string& text);
  // <element attributes/>
  void Empty(const std::string& element, const Attributes& attributes);

  // The document so far, with a declaration at its head.
  std::string Text() const;

 private:
  tinyxml2::XMLDocument document_;
  tinyxml2::XMLNode* open_ = &document_;  // the element that is open; the document's
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_FORMATS_XML_WRITER_H_
