#include <vtm/asset/mapped_asset.hpp>

#include <unistd.h>

#include <cstdlib>
#include <system_error>

#include <gtest/gtest.h>

#include <vtm/asset/evaluate.hpp>
#include <vtm/image/codec.hpp>
#include "asset/testing.hpp"
#include "asset/testing_files.hpp"
#include "asset/testing_views.hpp"

namespace vtm::asset::test {
namespace {

/// A file that goes away with its test.
class TemporaryFile {
public:
    explicit TemporaryFile(const Bytes& bytes) {
        close(mkstemp(path_.data()));
        image::writeFile(path_, bytes);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() { unlink(path_.c_str()); }
    const std::string& path() const { return path_; }

private:
    std::string path_ = testing::TempDir() + "vtm_mapped_XXXXXX";
};

template <class Record>
bool liesIn(std::span<const std::uint8_t> file, std::span<const Record> records) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(records.data());
    return !records.empty() && first >= file.data() &&
           first + records.size_bytes() <= file.data() + file.size() && (first - file.data()) % 64 == 0;
}

TEST(MappedAsset, UsesItsRecordsWhereTheyLie) {
    const TemporaryFile file(write(everySection()));
    const MappedAsset mapped(file.path());
    const AssetView& view = mapped.view();
    EXPECT_TRUE(liesIn(mapped.bytes(), view.maps));
    EXPECT_TRUE(liesIn(mapped.bytes(), view.commands));
    EXPECT_TRUE(liesIn(mapped.bytes(), view.nodes));
    EXPECT_TRUE(liesIn(mapped.bytes(), view.leaves));
    EXPECT_TRUE(liesIn(mapped.bytes(), view.pieces));
    EXPECT_TRUE(liesIn(mapped.bytes(), view.paints));
    EXPECT_TRUE(liesIn(mapped.bytes(), view.data));
    EXPECT_TRUE(liesIn(mapped.bytes(), view.prefilter.texels));
}

TEST(MappedAsset, DrawsAsTheAssetDoes) {
    for (const Asset& asset : {everySection(), layers(), twoLevels()}) {
        const TemporaryFile file(write(asset));
        MappedAsset first(file.path());
        const MappedAsset mapped = std::move(first);
        const View view = turnedView(32, 32, {32, 32}, 0.7, 0.4);
        EXPECT_EQ(evaluate(mapped.view(), view).rgba, evaluate(asset, view).rgba);
        EXPECT_EQ(summarize(mapped.view()).pieces, summarize(asset).pieces);
        EXPECT_EQ(write(mapped.view()), write(asset));
    }
}

TEST(MappedAsset, RefusesWhatTheReaderRefuses) {
    Bytes bytes = write(everySection());
    bytes[bytes.size() / 2] ^= 1;
    EXPECT_THROW(MappedAsset(TemporaryFile(bytes).path()), FormatError);
    EXPECT_THROW(MappedAsset(TemporaryFile({}).path()), FormatError);
    EXPECT_THROW(MappedAsset("/absent/picture.vtm"), std::system_error);
    EXPECT_THROW(MappedAsset(testing::TempDir()), std::system_error);
}

}  // namespace
}  // namespace vtm::asset::test
