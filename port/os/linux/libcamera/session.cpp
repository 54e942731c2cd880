/* Negotiating with a camera, and moving its buffers around. */
#include "session.hpp"

#include <algorithm>
#include <chrono>

#include "failure.hpp"
#include "formats.hpp"

namespace iris
{

hold::hold(std::shared_ptr<libcamera::Camera> found) : camera(std::move(found))
{
    check(camera->acquire(), "the camera is not to be had");
}

hold::~hold()
{
    camera->release();
}

session::session(iris_capture_grant *grant, const char *path, const iris_capture_config &wanted)
    : held(all.find(path)), camera(*held.camera)
{
    negotiate(grant, wanted);
    set_rate(grant, wanted.rate_millihz);
    allocate(grant);
    camera.requestCompleted.connect(this, &session::completed);
    camera.disconnected.connect(this, &session::disconnected);
}

session::~session()
{
    stop();
    camera.disconnected.disconnect(this);
    camera.requestCompleted.disconnect(this);
}

/* What the camera offers, for its sensor's own pixels or for pictures. */
static std::unique_ptr<libcamera::CameraConfiguration> offer_of(libcamera::Camera &camera, int32_t format)
{
    if (is_bayer(format)) {
        auto raw = camera.generateConfiguration({libcamera::StreamRole::Raw});
        if (raw && !raw->empty()) {
            return raw;
        }
    }
    auto offer = camera.generateConfiguration({libcamera::StreamRole::Viewfinder});
    if (!offer || offer->empty()) {
        throw failure(IRIS_ERR_UNSUPPORTED, "the camera offers no stream of pictures");
    }
    return offer;
}

void session::negotiate(iris_capture_grant *grant, const iris_capture_config &wanted)
{
    config = offer_of(camera, wanted.format);
    libcamera::StreamConfiguration &stream = config->at(0);
    stream.pixelFormat = choose_format(stream, wanted.format);
    stream.bufferCount = static_cast<unsigned>(wanted.buffers);
    if (wanted.size.w != 0) {
        stream.size =
            libcamera::Size(static_cast<unsigned>(wanted.size.w), static_cast<unsigned>(wanted.size.h));
    }
    if (is_yuv(format_of(stream.pixelFormat))) {
        stream.colorSpace = libcamera::ColorSpace::Smpte170m;
    }
    if (config->validate() == libcamera::CameraConfiguration::Invalid) {
        throw failure(IRIS_ERR_RANGE, "the camera knows nothing that comes near to this");
    }
    grant->format = format_of(stream.pixelFormat);
    if (grant->format == 0 || (wanted.format != 0 && grant->format != wanted.format)) {
        throw failure(IRIS_ERR_FORMAT, "the camera would make it " + stream.pixelFormat.toString());
    }
    check(camera.configure(config.get()), "the camera refuses its own proposal");
    if (stream.size.width > IRIS_SIDE_MAX || stream.size.height > IRIS_SIDE_MAX ||
        stream.stride > INT32_MAX) {
        throw failure(IRIS_ERR_RANGE, "the camera's pictures are too large: " + stream.size.toString());
    }
    grant->size.w = static_cast<int32_t>(stream.size.width);
    grant->size.h = static_cast<int32_t>(stream.size.height);
    grant->stride = static_cast<int32_t>(stream.stride);
    grant->matrix = matrix_of(stream.colorSpace);
    grant->range = range_of(stream.colorSpace);
}

void session::set_rate(iris_capture_grant *grant, int32_t rate_millihz)
{
    const auto known = camera.controls().find(libcamera::controls::FRAME_DURATION_LIMITS);
    if (rate_millihz == 0 || known == camera.controls().end()) {
        return;
    }
    int64_t frame_us = (1000000000 + rate_millihz / 2) / rate_millihz;
    const libcamera::ControlValue &shortest = known->second.min(), &longest = known->second.max();
    if (shortest.type() == libcamera::ControlTypeInteger64 && !shortest.isArray() &&
        longest.type() == libcamera::ControlTypeInteger64 && !longest.isArray()) {
        frame_us = std::max(std::min(frame_us, longest.get<int64_t>()), shortest.get<int64_t>());
    }
    const std::array<int64_t, 2> limits = {frame_us, frame_us};
    controls = std::make_unique<libcamera::ControlList>(camera.controls());
    controls->set(libcamera::controls::FRAME_DURATION_LIMITS,
                  libcamera::ControlValue(libcamera::Span<const int64_t>(limits)));
    grant->rate_millihz = static_cast<int32_t>(1000000000 / std::max<int64_t>(frame_us, 1));
}

void session::allocate(iris_capture_grant *grant)
{
    libcamera::Stream *stream = config->at(0).stream();
    allocator = std::make_unique<libcamera::FrameBufferAllocator>(held.camera);
    check(allocator->allocate(stream), "the camera gets no buffers");
    for (const auto &buffer : allocator->buffers(stream)) {
        if (slot_count == IRIS_CAPTURE_BUFFERS_MAX) {
            break;
        }
        slot &slot = slots[static_cast<size_t>(slot_count)];
        slot.buffer = buffer.get();
        slot.map(*grant);
        slot.request = camera.createRequest(static_cast<uint64_t>(slot_count));
        check(slot.request ? slot.request->addBuffer(stream, slot.buffer) : -ENOMEM,
              "the camera takes no request");
        slot_count++;
    }
    if (slot_count < 2) {
        throw failure(IRIS_ERR_RANGE, "the camera has one buffer only, and two are needed");
    }
    grant->buffers = slot_count;
    grant->stride = static_cast<int32_t>(slots[0].image.stride);
}

void session::completed(libcamera::Request *request)
{
    const std::lock_guard<std::mutex> lock(mutex);
    const auto index = static_cast<size_t>(request->cookie());
    if (request->status() == libcamera::Request::RequestCancelled) {
        slots[index].where = slot::idle;
        broken = broken || running;
    } else {
        slots[index].where = slot::waiting;
        line[static_cast<size_t>(line_length++)] = static_cast<int32_t>(index);
    }
    arrived.notify_one();
}

void session::disconnected()
{
    const std::lock_guard<std::mutex> lock(mutex);
    gone = true;
    broken = true;
    arrived.notify_one();
}

/* Hands a buffer to the camera. */
void session::queue(slot &slot)
{
    {
        const std::lock_guard<std::mutex> lock(mutex);
        slot.where = slot::at_camera;
    }
    slot.request->reuse(libcamera::Request::ReuseBuffers);
    const int result = camera.queueRequest(slot.request.get());
    if (result < 0) {
        const std::lock_guard<std::mutex> lock(mutex);
        slot.where = slot::idle;
    }
    check(result, "the camera takes no buffer");
}

void session::start()
{
    {
        const std::lock_guard<std::mutex> lock(mutex);
        if (gone) {
            throw failure(IRIS_ERR_IO, "the camera was removed");
        }
        broken = false;
        running = true;
    }
    check(camera.start(controls.get()), "the camera does not start");
    for (int32_t i = 0; i < slot_count; i++) {
        slot &slot = slots[static_cast<size_t>(i)];
        if (slot.where == slot::idle) {
            queue(slot);
        }
    }
}

/* Waits for a frame; -1 when none came in time. */
int32_t session::next(int32_t timeout_ms)
{
    std::unique_lock<std::mutex> lock(mutex);
    arrived.wait_for(lock, std::chrono::milliseconds(timeout_ms),
                     [this] { return line_length > 0 || broken; });
    if (line_length > 0) {
        const int32_t index = line[0];
        std::copy(line.begin() + 1, line.end(), line.begin());
        line_length--;
        slots[static_cast<size_t>(index)].where = slot::borrowed;
        return index;
    }
    if (broken) {
        throw failure(IRIS_ERR_IO,
                      gone ? "the camera was removed" : "the camera gave up in the middle of the stream");
    }
    return -1;
}

iris_status session::take(iris_frame *frame, int32_t timeout_ms)
{
    const int32_t index = next(timeout_ms);
    if (index < 0) {
        return IRIS_ERR_TIMEOUT;
    }
    slot &slot = slots[static_cast<size_t>(index)];
    const libcamera::FrameMetadata &metadata = slot.buffer->metadata();
    frame->sequence = metadata.sequence;
    frame->time_us = static_cast<int64_t>(metadata.timestamp / 1000);
    if (!slot.is_whole()) {
        queue(slot);
        return IRIS_ERR_DATA;
    }
    slot.begin_reading();
    frame->image = slot.image;
    frame->chroma = slot.chroma;
    frame->buffer = index;
    return IRIS_OK;
}

void session::give(int32_t buffer)
{
    slot &slot = slots[static_cast<size_t>(buffer)];
    slot.end_reading();
    queue(slot);
}

/* All that is not borrowed waits for the next start. */
void session::forget()
{
    const std::lock_guard<std::mutex> lock(mutex);
    running = false;
    line_length = 0;
    for (slot &slot : slots) {
        if (slot.where != slot::borrowed) {
            slot.where = slot::idle;
        }
    }
}

void session::stop() noexcept
{
    {
        const std::lock_guard<std::mutex> lock(mutex);
        running = false;
    }
    try {
        camera.stop(); /* cancels what the camera has, and returns when that is done */
    } catch (...) {
        gone = true;
    }
    forget();
}

} // namespace iris
