#include "client/formats/xml_writer.h"

namespace rollgait::client {

XmlWriter::XmlWriter() { document_.InsertFirstChild(document_.NewDeclaration()); }

void XmlWriter::Comment(const std::string& text) {
  // Two hyphens may not stand in a comment.
  std::string comment = " " + text + " ";
  for (size_t at = comment.find("--"); at != std::string::npos; at = comment.find("--")) comment.replace(at, 2, "- -");
  open_->InsertEndChild(document_.NewComment(comment.c_str()));
}

void XmlWriter::Open(const std::string& element, const Attributes& attributes) {
  tinyxml2::XMLElement* const opened = document_.NewElement(element.c_str());
  for (const auto& [name, value] : attributes) opened->SetAttribute(name.c_str(), value.c_str());
  open_ = open_->InsertEndChild(opened);
}

void XmlWriter::Close() { open_ = open_->Parent(); }

void XmlWriter::Leaf(const std::string& element, const std::string& text) {
  Open(element);
  open_->ToElement()->SetText(text.c_str());
  Close();
}

void XmlWriter::Empty(const std::string& element, const Attributes& attributes) {
  Open(element, attributes);
  Close();
}

std::string XmlWriter::Text() const {
  tinyxml2::XMLPrinter printer;
  document_.Print(&printer);
  return printer.CStr();
}

}  // namespace rollgait::client
