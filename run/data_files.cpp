// SPDX-License-Identifier: Apache-2.0
#include "run/data_files.h"

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include "bone/import/data_file.h"
#include "documents/read_procedure.h"
#include "documents/yaml/document.h"
#include "text/codes.h"
#include "text/printable.h"

namespace kerf::run {
namespace {

void check_data_file(const documents::Node& node, const std::string& document, documents::Report& report) {
    std::error_code ignored;
    if (node.kind != documents::Node::Kind::scalar ||
        std::filesystem::exists(bone::found_data_file(node.text, document), ignored))
        return;
    const char* data = std::getenv("KERF_DATA");
    const std::string first = node.text.substr(0, node.text.find('/'));
    report.error(
        text::Code::no_data_file, node.span,
        data != nullptr && *data != '\0'
            ? "The file or folder does not exist: searched in the document's folder and in `" + text::printable(data) +
                  "`, which KERF_DATA names. Check its name, and that KERF_DATA names the folder that "
                  "holds `" +
                  text::excerpt(first) + "`."
            : "The file or folder does not exist: searched in the document's folder; KERF_DATA is not set. Check its "
              "name, or name the folder that holds `" +
                  text::excerpt(first) + "`, as in `export KERF_DATA=/home/me/data`.");
}

}  // namespace

void check_data_files(const documents::Anatomy& anatomy, text::Diagnostics& diagnostics) {
    const documents::Document document = documents::read_again(anatomy.file, anatomy.text);
    documents::Report report(document, diagnostics);
    const auto check = [&](const documents::Node* map, const char* key) {
        if (const documents::Node* node = map != nullptr ? map->find(key) : nullptr)
            check_data_file(*node, anatomy.file, report);
    };
    const documents::Node* ct = document.root.find("ct");
    check(ct, "image");
    check(ct != nullptr ? ct->find("labels") : nullptr, "file");
    const documents::Node* mesh = document.root.find("mesh");
    check(mesh, "file");
    check(mesh != nullptr ? mesh->find("canal") : nullptr, "file");
    const documents::Node* landmarks = document.root.find("landmarks");
    if (const documents::Node* markups = landmarks != nullptr ? landmarks->find("markups") : nullptr)
        for (const documents::Node& item : markups->children) check(&item, "file");
}

void check_implant_files(const documents::Procedure& procedure, text::Diagnostics& diagnostics) {
    const auto document = documents::document_of(procedure);
    documents::Report report(*document, diagnostics);
    for (const documents::Implant& implant : procedure.implants) {
        const documents::Node* node = &document->root;
        for (const std::string& key : {std::string("implants"), implant.id, std::string("mesh"), std::string("file")})
            if (node != nullptr) node = node->find(key);
        if (node != nullptr) check_data_file(*node, procedure.file, report);
    }
}

}  // namespace kerf::run
