// SPDX-License-Identifier: Apache-2.0
#include "bone/image/dicom_identity.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/dicom_writer.h"
#include "tests/support/temporary_folder.h"

namespace kerf::bone {
namespace {

using test::DicomWriter;
using test::TemporaryFolder;

/// One item with the patient's name and a text, as a sequence's value.
std::string item() {
    const std::string elements =
        std::string("\x10\x00\x10\x00PN\x04\x00", 8) + "Roe " + std::string("\x18\x00\x00\x11LO\x02\x00", 8) + "at";
    return std::string("\xfe\xff\x00\xe0", 4) + static_cast<char>(elements.size()) + std::string(3, '\0') + elements;
}

TEST(DicomIdentity, ReadsElementsInAndOutsideSequences) {
    const TemporaryFolder folder;
    DicomWriter()
        .text(0x00100010, "PN", "Doe^Jane")
        .text(0x00280301, "CS", "YES")
        .text(0x00091001, "LO", "private")
        .text(0x00180015, "CS", "SPINE")
        .raw(0x00081120, "SQ", item())
        .write(folder / "a.dcm");

    const DicomIdentity identity = read_dicom_identity(folder / "a.dcm");

    ASSERT_EQ(identity.elements.size(), 2u);
    EXPECT_EQ(identity.elements[0].name, "patient's name (0010,0010)");
    EXPECT_EQ(identity.elements[0].value, "Doe^Jane");
    EXPECT_FALSE(identity.elements[0].is_in_sequence);
    EXPECT_EQ(identity.elements[1].value, "Roe");
    EXPECT_TRUE(identity.elements[1].is_in_sequence);
    EXPECT_EQ(identity.nested_texts, "at\n");
    EXPECT_EQ(identity.private_elements, 1u);
    EXPECT_TRUE(identity.has_text_in_picture);
    EXPECT_FALSE(identity.is_deflated);
    EXPECT_EQ(identity.fault, "");
    EXPECT_EQ(identity.sequence_fault, "");
}

TEST(DicomIdentity, LeavesOutEmptyElements) {
    const TemporaryFolder folder;
    DicomWriter().text(0x00100010, "PN", "").text(0x00100020, "LO", "  ").write(folder / "a.dcm");
    EXPECT_TRUE(read_dicom_identity(folder / "a.dcm").elements.empty());
}

TEST(DicomIdentity, ReportsAFaultInASequence) {
    const TemporaryFolder folder;
    std::string damaged = item();
    damaged.replace(damaged.find("PN") + 2, 2, "\xff\x7f");  // longer than the file
    DicomWriter().text(0x00100020, "LO", "4711").raw(0x00081120, "SQ", damaged).write(folder / "a.dcm");

    const DicomIdentity identity = read_dicom_identity(folder / "a.dcm");

    EXPECT_NE(identity.sequence_fault, "");
    ASSERT_EQ(identity.elements.size(), 1u);
    EXPECT_EQ(identity.elements[0].value, "4711");
}

TEST(DicomIdentity, IsEmptyForOtherFiles) {
    const TemporaryFolder folder;
    std::ofstream(folder / "a.txt") << "Doe^Jane";
    const DicomIdentity identity = read_dicom_identity(folder / "a.txt");
    EXPECT_TRUE(identity.elements.empty());
    EXPECT_EQ(identity.private_elements, 0u);
}

}  // namespace
}  // namespace kerf::bone
