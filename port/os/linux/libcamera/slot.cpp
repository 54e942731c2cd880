/* Mapping a buffer's planes. */
#include "slot.hpp"

#include <cerrno>

#include <linux/dma-buf.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "failure.hpp"

namespace iris
{

mapping::~mapping()
{
    if (memory) {
        munmap(memory, bytes);
    }
}

void mapping::map(iris_image *view, const libcamera::FrameBuffer::Plane &plane, iris_size size,
                  ptrdiff_t stride, iris_format format)
{
    const size_t length = static_cast<size_t>(plane.offset) + plane.length;
    const off_t there = lseek(plane.fd.get(), 0, SEEK_END); /* below 0: a buffer that does not say */
    if (there >= 0 && static_cast<size_t>(there) < length) {
        throw failure(IRIS_ERR_DATA, "a buffer of the camera is smaller than it says");
    }
    void *mapped = mmap(nullptr, length, PROT_READ, MAP_SHARED, plane.fd.get(), 0);
    check(mapped == MAP_FAILED ? -errno : 0, "a buffer of the camera cannot be mapped");
    memory = mapped;
    bytes = length;
    handle = plane.fd.get();
    const iris_status status = iris_image_wrap(view, static_cast<uint8_t *>(memory) + plane.offset,
                                               plane.length, size, stride, format);
    if (status != IRIS_OK) {
        throw failure(IRIS_ERR_DATA, std::string("a buffer of the camera holds no such picture: ") +
                                         iris_status_text(status));
    }
    needed = static_cast<size_t>(view->stride) * static_cast<size_t>(size.h - 1) +
             iris_format_row_bytes(format, size.w);
}

/* Memory that is no DMA buffer needs no call, and refuses it. */
void mapping::begin_reading() const
{
    struct dma_buf_sync sync = {DMA_BUF_SYNC_START | DMA_BUF_SYNC_READ};
    (void)ioctl(handle, DMA_BUF_IOCTL_SYNC, &sync);
}

void mapping::end_reading() const
{
    struct dma_buf_sync sync = {DMA_BUF_SYNC_END | DMA_BUF_SYNC_READ};
    (void)ioctl(handle, DMA_BUF_IOCTL_SYNC, &sync);
}

void slot::map(const iris_capture_grant &grant)
{
    const bool two = grant.format == IRIS_CAPTURE_NV12;
    const auto &parts = buffer->planes();
    if (parts.size() != (two ? 2u : 1u)) {
        throw failure(IRIS_ERR_DATA, "a buffer of the camera has another number of planes than its format");
    }
    planes[0].map(&image, parts[0], grant.size, grant.stride,
                  two ? IRIS_GRAY8 : static_cast<iris_format>(grant.format));
    if (two) {
        const iris_size half = {(grant.size.w + 1) / 2, (grant.size.h + 1) / 2};
        planes[1].map(&chroma, parts[1], half, grant.stride, IRIS_UV88);
    }
}

bool slot::is_whole() const
{
    const auto &metadata = buffer->metadata();
    const auto filled = metadata.planes();
    if (metadata.status != libcamera::FrameMetadata::FrameSuccess) {
        return false;
    }
    for (size_t i = 0; i < (chroma.data ? 2u : 1u); i++) {
        if (i >= filled.size() || filled[i].bytesused < planes[i].needed) {
            return false;
        }
    }
    return true;
}

void slot::begin_reading() const
{
    planes[0].begin_reading();
    if (chroma.data) {
        planes[1].begin_reading();
    }
}

void slot::end_reading() const
{
    planes[0].end_reading();
    if (chroma.data) {
        planes[1].end_reading();
    }
}

} // namespace iris
