"""What OpenCV and IRIS both do, a row each: OpenCV's side of it, and when the two results agree.

A row's function gets the pictures (p.gray, p.color, p.mask: 8 bits, a mask is 0 and 255) and returns the call that is
timed. Its agreement gets both results and says whether they are the same, and how far apart they are. IRIS's side is the
case of the same name in the C files here."""
import math

import cv2
import numpy as np

ROWS = []


def row(name, goal, agree, gray="-", color="-", mask="-"):
    """goal: times as fast as the better OpenCV, 0 for none; gray, color, mask: pictures of pictures.py."""
    def add(make):
        ROWS.append(dict(name=name, goal=goal, agree=agree, make=make, gray=gray, color=color, mask=mask))
        return make
    return add


# --- agreement ---

def differ(ours, theirs, most, share=1.0):
    """No farther apart than `most`, in at least this share of the values."""
    if ours.shape != theirs.shape:
        return False, "shapes %s and %s" % (ours.shape, theirs.shape)
    apart = np.abs(ours.astype(np.int64) - theirs.astype(np.int64))
    good = float(np.mean(apart <= most)) >= share
    if not apart.any():
        return good, "equal"
    return good, "%.2f %% equal, %.2f %% within %d, at most %d" % (
        100 * np.mean(apart == 0), 100 * np.mean(apart <= max(most, 1)), max(most, 1), apart.max())


def exact(ours, theirs, p):
    return differ(ours, theirs, 0)


def within(most, share=1.0):
    return lambda ours, theirs, p: differ(ours, theirs, most, share)


def signed(ours):
    return ours.view(np.int32)


def hsl(ours, theirs, p):
    """Channels are H S L and H L S; hue goes around, and says nothing where there is hardly any color."""
    h, l, s = (theirs[..., i].astype(int) for i in range(3))
    hue = np.abs((ours[..., 0] - h + 128) % 256 - 128)[s > 8]
    apart = max(np.abs(ours[..., 1] - s).max(), np.abs(ours[..., 2] - l).max())
    return bool(apart <= 1 and np.mean(hue <= 1) > 0.999), "S and L within %d, H within 1 in %.2f %%" % (
        apart, 100 * np.mean(hue <= 1))


def lines(ours, theirs, p):
    """Of the ten best lines of each, how many has the other within 2 pixels and 1.5 degrees?"""
    ours = signed(ours)
    ours = ours[ours[:, 2] > 0]
    a = np.stack([ours[:, 0] * (math.pi / 32768), ours[:, 1] / 65536], 1)
    rho, theta = theirs.reshape(-1, theirs.shape[-1])[:, :2].T.astype(float)
    b = np.stack([theta, rho - (p.w - 1) / 2 * np.cos(theta) - (p.h - 1) / 2 * np.sin(theta)], 1)

    def found(one, others):
        turn = (others[:, 0] - one[0] + math.pi / 2) % math.pi - math.pi / 2
        same = np.cos(others[:, 0] - one[0]) > 0
        rho = np.abs(np.where(same, others[:, 1], -others[:, 1]) - one[1])
        return bool(np.any((rho <= 2) & (np.abs(turn) <= math.radians(1.5))))
    hits = [sum(found(one, others) for one in some[:10]) for some, others in ((a, b), (b, a))]
    return min(hits) >= 9, "of the ten best of ours and theirs the other has %d and %d; lines %d and %d" % (
        *hits, len(a), len(b))


def circles(ours, theirs, p):
    """How many circles of each has the other, center and radius within a hundredth of the width? Theirs has more doubtful
    ones: what ours finds shall be among them."""
    a = ours[ours[:, 2] > 0] / 65536
    b = np.zeros((0, 3)) if theirs is None else theirs.reshape(-1, theirs.shape[-1])[:, :3]
    near = p.w / 100
    hits = [sum(bool(np.any(np.abs(others - one).max(1) <= near)) for one in some)
            for some, others in ((a, b), (b, a))]
    return hits[0] >= 0.8 * len(a) and len(a) >= len(b) / 2 > 0, "ours %d, %d of them theirs; theirs %d, %d of them ours" % (
        len(a), hits[0], len(b), hits[1])


def blobs(ours, theirs, p):
    """The same boxes and areas; behind the first of theirs, which is the background."""
    a = sorted(map(tuple, ours[ours[:, 4] > 0].tolist()))
    b = sorted(map(tuple, theirs[2][1:].tolist()))
    return a == b, "%s, %d parts" % ("equal" if a == b else "different", len(b))


def moments(ours, theirs, p):
    a = ours.view(np.int64).ravel()
    b = [theirs[name] for name in "m00 m10 m01 m20 m11 m02 m30 m21 m12 m03".split()]
    apart = max(abs(x - y) / max(abs(y), 1) for x, y in zip(a.tolist(), b))
    return apart < 1e-12, "equal" if apart < 1e-12 else "%g apart" % apart


def contours(ours, theirs, p):
    """The same outer borders and holes by their boxes; theirs run around a hole on the pixels outside of it."""
    a = sorted(tuple(c) for c in ours[ours[:, 0] > 0][:, :5].tolist())
    found, tree = theirs
    b = []
    for points, kin in zip(found, tree[0]):
        x, y, w, h = cv2.boundingRect(points)
        b.append((2, x + 1, y + 1, w - 2, h - 2) if kin[3] >= 0 else (1, x, y, w, h))
    return a == sorted(b), "%s, %d borders" % ("equal" if a == sorted(b) else "different", len(b))


def lean(vx, vy):
    """Degrees from straight up, positive to the right, of a line with this direction."""
    return math.degrees(math.atan2(-vx if vy > 0 else vx, abs(vy)))


def apart(a, b):
    return abs((a - b + 90) % 180 - 90)


def fitted(ours, theirs, p):
    angle = signed(ours)[0, 0] * 180 / 32768
    d = apart(angle, lean(float(theirs[0][0]), float(theirs[1][0])))
    return d < 0.2, "%.2f degrees apart" % d


def followed(ours, theirs, p):
    """The line in the middle row, and its angle: ours is that of the line at the robot, theirs of all of it."""
    found, twice_x, angle = signed(ours)[0, :3].tolist()
    cx, cy, theta = theirs
    turn = lean(math.cos(theta), math.sin(theta))
    x = cx + (cy - p.h // 2) * math.tan(math.radians(turn))
    dx, da = abs(twice_x / 2 - x), apart(angle * 180 / 32768, turn)
    return bool(found and dx < p.w / 100 and da < 2), "%.1f pixels and %.1f degrees apart" % (dx, da)


def directions(ours, theirs, p):
    """Angles of a turn, where there is a gradient: theirs are off by up to 0.3 degrees."""
    dx, dy = cv2.spatialGradient(p.gray)
    apart = np.abs((ours * (360 / 65536) - theirs + 180) % 360 - 180)[(dx != 0) | (dy != 0)]
    return bool(apart.max() < 0.5), "within %.2f degrees" % apart.max()


def file_of(ours, theirs, p):
    """Their reader of files finds the picture in ours."""
    picture = p.gray if p.color is None else p.color
    same = np.array_equal(cv2.imdecode(ours.ravel().view(np.uint8), cv2.IMREAD_UNCHANGED), picture)
    return same, "our file holds the picture" if same else "our file holds another picture"


def disparities(most, share):
    """Where both have a match, and the pixel is seen by both, they are within `most` pixels in so large a share."""
    def agree(ours, theirs, p):
        seen = np.zeros((p.h, p.w), bool)
        seen[8:-8, 72:-8] = True
        seen &= (theirs > 0) & (ours > 0)
        apart = np.abs(ours / 256 - theirs / 16)[seen]
        good = float(np.mean(apart <= most))
        return good >= share and seen.mean() > .5, "%.2f %% within %g pixels, of %.0f %% that both matched" % (
            100 * good, most, 100 * seen.mean())
    return agree


# --- colors ---

@row("BGR to gray", 2.3, within(1), color="coffee")
def _(p):
    to = np.empty((p.h, p.w), np.uint8)
    return lambda: cv2.cvtColor(p.color, cv2.COLOR_BGR2GRAY, to)


@row("BGR to HSL", 1.2, hsl, color="coffee")
def _(p):
    to = np.empty_like(p.color)
    return lambda: cv2.cvtColor(p.color, cv2.COLOR_BGR2HLS_FULL, to)


@row("HSL to BGR", 0, within(8, 0.99), color="coffee")
def _(p):
    to, hls = np.empty_like(p.color), cv2.cvtColor(p.color, cv2.COLOR_BGR2HLS_FULL)
    return lambda: cv2.cvtColor(hls, cv2.COLOR_HLS2BGR_FULL, to)


@row("BGR to RGB", 0, exact, color="coffee")
def _(p):
    to = np.empty_like(p.color)
    return lambda: cv2.cvtColor(p.color, cv2.COLOR_BGR2RGB, to)


@row("gray to RGB", 0, exact, gray="coffee")
def _(p):
    to = np.empty((p.h, p.w, 3), np.uint8)
    return lambda: cv2.cvtColor(p.gray, cv2.COLOR_GRAY2RGB, to)


def yuyv(p):
    return np.ascontiguousarray(p.color.ravel()[:p.w * p.h * 2].reshape(p.h, p.w, 2))


@row("YUYV to gray", 0, exact, color="yuyv")
def _(p):
    to, pairs = np.empty((p.h, p.w), np.uint8), yuyv(p)
    return lambda: cv2.cvtColor(pairs, cv2.COLOR_YUV2GRAY_YUYV, to)


@row("YUYV to RGB", 0, within(2), color="yuyv")
def _(p):
    to, pairs = np.empty((p.h, p.w, 3), np.uint8), yuyv(p)
    return lambda: cv2.cvtColor(pairs, cv2.COLOR_YUV2RGB_YUYV, to)


@row("NV12 to RGB", 0, within(2), gray="nv12", color="nv12")
def _(p):
    to = np.empty((p.h, p.w, 3), np.uint8)
    planes = np.vstack([p.gray, p.color.ravel()[:p.w * p.h // 2].reshape(p.h // 2, p.w)])
    return lambda: cv2.cvtColor(planes, cv2.COLOR_YUV2RGB_NV12, to)


@row("Bayer to RGB", 0, within(1, 0.98), gray="coffee")
def _(p):
    to = np.empty((p.h, p.w, 3), np.uint8)
    return lambda: cv2.cvtColor(p.gray, cv2.COLOR_BayerRGGB2RGB, to)


@row("one channel of BGR", 0, exact, color="coffee")
def _(p):
    to = np.empty((p.h, p.w), np.uint8)
    return lambda: cv2.extractChannel(p.color, 1, to)


@row("BGR to mask by a range of HSL", 4, within(0, 0.98), color="coffee")
def _(p):
    to, hls = np.empty((p.h, p.w), np.uint8), np.empty_like(p.color)
    low, high = (9, 38, 51), (28, 204, 230)  # 12 to 40 degrees, L 15 to 80 %, S 20 to 90 %
    return lambda: cv2.inRange(cv2.cvtColor(p.color, cv2.COLOR_BGR2HLS_FULL, hls), low, high, to)


@row("range test, 1 channel", 2.5, exact, gray="coffee")
def _(p):
    to = np.empty_like(p.gray)
    return lambda: cv2.inRange(p.gray, 128, 255, to)


@row("line follow by color", 9, followed, color="line")
def _(p):
    hsv, a, b = np.empty_like(p.color), np.empty((p.h, p.w), np.uint8), np.empty((p.h, p.w), np.uint8)
    square = np.ones((3, 3), np.uint8)

    def follow():
        cv2.cvtColor(p.color, cv2.COLOR_BGR2HSV, hsv)
        cv2.inRange(hsv, (165, 80, 50), (180, 255, 255), a)
        cv2.erode(a, square, b)
        cv2.dilate(b, square, a)
        m = cv2.moments(a, True)
        return m["m10"] / m["m00"], m["m01"] / m["m00"], 0.5 * math.atan2(2 * m["mu11"], m["mu20"] - m["mu02"])
    return follow


# --- levels ---

@row("threshold", 1, exact, gray="coffee")
def _(p):
    to = np.empty_like(p.gray)
    return lambda: cv2.threshold(p.gray, 127, 255, cv2.THRESH_BINARY, to)[1]


@row("threshold, Otsu", 0, exact, gray="coffee")
def _(p):
    to = np.empty_like(p.gray)
    return lambda: cv2.threshold(p.gray, 0, 255, cv2.THRESH_OTSU, to)[1]


@row("threshold, adaptive 25x25", 0, within(0, 0.98), gray="coffee")
def _(p):
    to = np.empty_like(p.gray)
    return lambda: cv2.adaptiveThreshold(p.gray, 255, cv2.ADAPTIVE_THRESH_MEAN_C, cv2.THRESH_BINARY_INV, 25, 5, to)


@row("histogram", 1.1, lambda a, b, p: exact(a.ravel(), b.ravel(), p), gray="coffee")
def _(p):
    return lambda: cv2.calcHist([p.gray], [0], None, [256], [0, 256])


@row("histogram of a mask", 0, lambda a, b, p: exact(a.ravel(), b.ravel(), p), gray="coffee", mask="coins")
def _(p):
    return lambda: cv2.calcHist([p.gray], [0], p.mask, [256], [0, 256])


@row("equalize", 1, within(1), gray="coffee")
def _(p):
    to = np.empty_like(p.gray)
    return lambda: cv2.equalizeHist(p.gray, to)


@row("equalize locally, 8x8 tiles", 0, within(6, 0.99), gray="coffee")
def _(p):
    to, clahe = np.empty_like(p.gray), cv2.createCLAHE(3.0, (8, 8))
    return lambda: clahe.apply(p.gray, to)


@row("linear stretch, darkest to brightest", 4, within(1), gray="coffee")
def _(p):
    to = np.empty_like(p.gray)

    def stretch():
        low, high, _, _ = cv2.minMaxLoc(p.gray)
        gain = 255 / (high - low)
        return cv2.convertScaleAbs(p.gray, to, gain, -low * gain)
    return stretch


@row("tone curve", 0, exact, gray="coffee")
def _(p):
    to = np.empty_like(p.gray)
    curve = np.clip(((np.arange(256) - 30) * 510 + 180) // 360, 0, 255).astype(np.uint8)
    return lambda: cv2.LUT(p.gray, curve, to)


# --- neighborhoods ---

def gaussian(name, goal, side, sigma, **picture):
    @row(name, goal, within(1), **picture)
    def _(p):
        source = p.gray if picture.get("gray") else p.color
        to = np.empty_like(source)
        return lambda: cv2.GaussianBlur(source, (side, side), sigma, to)


gaussian("Gaussian 5x5, sigma 0.8", 2, 5, 0.8, gray="coffee")
gaussian("Gaussian 5x5, binomial", 2, 5, 0, gray="coffee")
gaussian("Gaussian 5x5 of color", 0, 5, 0.8, color="coffee")
gaussian("Gaussian, sigma 3", 0, 21, 3, gray="coffee")


def filters(name, goal, agree, call, gray="coffee"):
    """Operations from gray to gray: call(to, gray)."""
    @row(name, goal, agree, gray=gray)
    def _(p):
        to = np.empty_like(p.gray)
        return lambda: call(p.gray, to)


SQUARE, LARGE = np.ones((3, 3), np.uint8), np.ones((15, 15), np.uint8)
filters("box 3x3", 0, exact, lambda a, to: cv2.blur(a, (3, 3), to))
filters("box 15x15", 0, within(1), lambda a, to: cv2.blur(a, (15, 15), to))
filters("median 3x3", 0, exact, lambda a, to: cv2.medianBlur(a, 3, to))
filters("median 5x5", 0, exact, lambda a, to: cv2.medianBlur(a, 5, to))
filters("dilate 3x3", 2.5, exact, lambda a, to: cv2.dilate(a, SQUARE, to))
filters("erode 3x3", 2.5, exact, lambda a, to: cv2.erode(a, SQUARE, to))
filters("erode 15x15", 0, exact, lambda a, to: cv2.erode(a, LARGE, to))
filters("open 3x3", 0, exact, lambda a, to: cv2.morphologyEx(a, cv2.MORPH_OPEN, SQUARE, to))
filters("morphological gradient 3x3", 0, exact, lambda a, to: cv2.morphologyEx(a, cv2.MORPH_GRADIENT, SQUARE, to))
filters("top-hat 15x15", 0, exact,
        lambda a, to: cv2.morphologyEx(a, cv2.MORPH_TOPHAT, LARGE, to))
filters("mirror", 0, exact, lambda a, to: cv2.flip(a, 1, to))
filters("copy", 0, exact, lambda a, to: cv2.copyTo(a, None, to))


@row("unsharp", 2.5, within(1), gray="coffee")
def _(p):
    blurred, to = np.empty_like(p.gray), np.empty_like(p.gray)
    return lambda: cv2.addWeighted(p.gray, 1.5, cv2.GaussianBlur(p.gray, (5, 5), 0.8, blurred), -0.5, 0, to)


def weights(side):
    """Those of make_kernel in filter.c."""
    i = np.arange(side * side)
    taps = (5 * i * i + 3) % 16 - 4
    return (taps / taps.sum()).astype(np.float32).reshape(side, side)


for side, aim in ((3, 5), (5, 4), (7, 2.5)):
    filters("convolve %dx%d" % (side, side), aim, within(1),
            lambda a, to, kernel=weights(side): cv2.filter2D(a, -1, kernel, to))


@row("convolve 3x3 of color", 0, within(1), color="coffee")
def _(p):
    kernel, to = weights(3), np.empty_like(p.color)
    return lambda: cv2.filter2D(p.color, -1, kernel, to)


# --- edges ---

@row("Sobel, abs dx + abs dy", 4, exact, gray="coffee")
def _(p):
    dx, dy = np.empty((p.h, p.w), np.int16), np.empty((p.h, p.w), np.int16)
    a, b, to = np.empty_like(p.gray), np.empty_like(p.gray), np.empty_like(p.gray)

    def sobel():
        cv2.Sobel(p.gray, cv2.CV_16S, 1, 0, dx)
        cv2.Sobel(p.gray, cv2.CV_16S, 0, 1, dy)
        return cv2.add(cv2.convertScaleAbs(dx, a), cv2.convertScaleAbs(dy, b), to)
    return sobel


@row("Sobel, dx and dy", 0, lambda a, b, p: exact(a, b[1], p), gray="coffee")
def _(p):
    dx, dy = np.empty((p.h, p.w), np.int16), np.empty((p.h, p.w), np.int16)
    return lambda: cv2.spatialGradient(p.gray, dx, dy)


@row("Laplacian, absolute", 2.5, exact, gray="coffee")
def _(p):
    wide, to = np.empty((p.h, p.w), np.int16), np.empty_like(p.gray)
    return lambda: cv2.convertScaleAbs(cv2.Laplacian(p.gray, cv2.CV_16S, wide, 1), to)


@row("Sobel, direction", 0, directions, gray="coffee")
def _(p):
    dx, dy, to = (np.empty((p.h, p.w), np.float32) for _ in range(3))

    def direction():
        cv2.Sobel(p.gray, cv2.CV_32F, 1, 0, dx)
        cv2.Sobel(p.gray, cv2.CV_32F, 0, 1, dy)
        return cv2.phase(dx, dy, to, True)
    return direction


filters("Canny, L1", 5, exact, lambda a, to: cv2.Canny(a, 50, 150, to))


@row("Hough lines, 1 pixel, 1 degree", 2.5, lines, mask="edges")
def _(p):
    return lambda: cv2.HoughLines(p.mask, 1, math.pi / 180, 150 * p.w // 640)


@row("Hough circles", 5, circles, gray="smooth_coins")
def _(p):
    s = p.w / 640
    return lambda: cv2.HoughCircles(p.gray, cv2.HOUGH_GRADIENT, 1, 20 * s, param1=100, param2=30 * s,
                                    minRadius=int(15 * s), maxRadius=int(60 * s))


# --- masks ---

@row("dilate a mask 3x3", 0, exact, mask="coins")
def _(p):
    to = np.empty_like(p.mask)
    return lambda: cv2.dilate(p.mask, SQUARE, to)


@row("open a mask 3x3", 0, exact, mask="coins")
def _(p):
    to = np.empty_like(p.mask)
    return lambda: cv2.morphologyEx(p.mask, cv2.MORPH_OPEN, SQUARE, to)


@row("close a mask 15x15", 0, exact, mask="coins")
def _(p):
    to = np.empty_like(p.mask)
    return lambda: cv2.morphologyEx(p.mask, cv2.MORPH_CLOSE, LARGE, to)


@row("hit-or-miss 3x3", 0, within(0, 0.999), mask="coins")
def _(p):
    to, corner = np.empty_like(p.mask), np.array([[0, 1, 0], [-1, 1, 1], [-1, -1, 0]])
    return lambda: cv2.morphologyEx(p.mask, cv2.MORPH_HITMISS, corner, to)


@row("distance, L1", 4, lambda a, b, p: exact(np.minimum(a, 255), b, p), mask="coins")
def _(p):
    return lambda: cv2.distanceTransform(p.mask, cv2.DIST_L1, 3, dstType=cv2.CV_8U)


@row("connected components with statistics", 10, blobs, mask="page")
def _(p):
    labels = np.empty((p.h, p.w), np.int32)
    return lambda: cv2.connectedComponentsWithStats(p.mask, labels, connectivity=8)


@row("moments of a mask", 10, moments, mask="coins")
def _(p):
    return lambda: cv2.moments(p.mask, True)


@row("thinning, Zhang-Suen", 50, within(0, 0.999), mask="horse")
def _(p):
    return lambda: cv2.ximgproc.thinning(p.mask, thinningType=cv2.ximgproc.THINNING_ZHANGSUEN)


@row("contours with their pixels", 0, contours, mask="page")
def _(p):
    return lambda: cv2.findContours(p.mask, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)


@row("line through a mask's pixels", 0, fitted, mask="tape")
def _(p):
    return lambda: cv2.fitLine(cv2.findNonZero(p.mask), cv2.DIST_L2, 0, 0.01, 0.01)


# --- places ---

@row("half the size, area", 0, exact, gray="coffee")
def _(p):
    to = np.empty((p.h // 2, p.w // 2), np.uint8)
    return lambda: cv2.resize(p.gray, (p.w // 2, p.h // 2), to, 0, 0, cv2.INTER_AREA)


@row("three quarters of the size, bilinear", 0, within(1), gray="coffee")
def _(p):
    size = p.w * 3 // 4, p.h * 3 // 4
    to = np.empty(size[::-1], np.uint8)
    return lambda: cv2.resize(p.gray, size, to, 0, 0, cv2.INTER_LINEAR)


@row("two thirds of the size, nearest", 0, within(0, 0.99), gray="coffee")
def _(p):
    size = p.w * 2 // 3, p.h * 2 // 3
    to = np.empty(size[::-1], np.uint8)
    return lambda: cv2.resize(p.gray, size, to, 0, 0, cv2.INTER_NEAREST_EXACT)


@row("pyramid, one level up", 0, within(1, 0.99), gray="coffee")
def _(p):
    to, quarter = np.empty_like(p.gray), p.gray[:p.h // 2, :p.w // 2]
    return lambda: cv2.pyrUp(quarter, to, (p.w, p.h))


@row("pyramid, one level down", 0, exact, gray="coffee")
def _(p):
    to = np.empty(((p.h + 1) // 2, (p.w + 1) // 2), np.uint8)
    return lambda: cv2.pyrDown(p.gray, to)


@row("quarter turn", 0, exact, gray="coffee")
def _(p):
    to = np.empty((p.w, p.h), np.uint8)
    return lambda: cv2.rotate(p.gray, cv2.ROTATE_90_CLOCKWISE, to)


@row("integral, 32 bit", 1, exact, gray="coffee")
def _(p):
    to = np.empty((p.h + 1, p.w + 1), np.int32)
    return lambda: cv2.integral(p.gray, to, cv2.CV_32S)


def floor(p):
    """From pixels of the map to those of the picture: the floor and the window of place.c."""
    ground = [(x, y) for y in (150, 400) for x in (-100, 100)]
    seen = [(p.w // 2 + int(p.w * x / (y + 200)), p.h // 2 + int(p.h * (200 - y) / (y + 200))) for x, y in ground]
    to_image = cv2.getPerspectiveTransform(np.float32(ground), np.float32(seen))
    step = (160 * 65536 // p.w) / 65536
    return to_image @ np.array([[step, 0, -80], [0, -step, 300], [0, 0, 1]])


@row("bird's-eye beside remap, its map ready", 2.3, within(2, 0.99), gray="coffee")
def _(p):
    to = np.empty_like(p.gray)
    x, y = np.meshgrid(np.arange(p.w), np.arange(p.h))
    u, v, w = np.tensordot(floor(p), np.stack([x, y, np.ones_like(x)]), 1)
    places, weights = cv2.convertMaps((u / w).astype(np.float32), (v / w).astype(np.float32), cv2.CV_16SC2)
    return lambda: cv2.remap(p.gray, places, weights, cv2.INTER_LINEAR, to)


@row("bird's-eye beside warpPerspective", 2.3, within(2, 0.99), gray="coffee")
def _(p):
    to, matrix = np.empty_like(p.gray), floor(p)
    return lambda: cv2.warpPerspective(p.gray, matrix, (p.w, p.h), to, cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP)


# --- space ---

def right_of(p):
    return np.ascontiguousarray(p.color.ravel()[:p.w * p.h].reshape(p.h, p.w))


def block_matcher():
    matcher = cv2.StereoBM_create(64, 15)
    matcher.setPreFilterCap(31)
    return matcher


@row("StereoBM 15x15, 64 disparities, plain", 2.2, disparities(1, 0.97), gray="pair", color="pair")
def _(p):
    matcher, right, to = block_matcher(), right_of(p), np.empty((p.h, p.w), np.int16)
    matcher.setTextureThreshold(0)
    matcher.setUniquenessRatio(0)
    return lambda: matcher.compute(p.gray, right, to)


@row("StereoBM 15x15, 64 disparities, default", 3.5, disparities(1, 0.97), gray="pair", color="pair")
def _(p):
    matcher, right, to = block_matcher(), right_of(p), np.empty((p.h, p.w), np.int16)
    return lambda: matcher.compute(p.gray, right, to)


@row("StereoSGBM, 64 disparities", 2, disparities(1, 0.97), gray="pair", color="pair")
def _(p):
    right, to = right_of(p), np.empty((p.h, p.w), np.int16)
    matcher = cv2.StereoSGBM_create(0, 64, 3, 8 * 9, 32 * 9, 1)
    return lambda: matcher.compute(p.gray, right, to)


def lens(p):
    """K and the distortion of the camera in space.c."""
    return np.array([[.8 * p.w, 0, p.w / 2], [0, .8 * p.w, p.h / 2], [0, 0, 1]]), np.array([-.3, 0, 0, 0, 0])


def remaps(name, goal, **picture):
    @row(name, goal, within(6, 0.99), **picture)
    def _(p):
        source = p.gray if picture.get("gray") else p.color
        k, bends = lens(p)
        to = np.empty_like(source)
        places, weights = cv2.initUndistortRectifyMap(k, bends, None, k, (p.w, p.h), cv2.CV_16SC2)
        return lambda: cv2.remap(source, places, weights, cv2.INTER_LINEAR, to)


remaps("remap bilinear, fixed-point map", 2.3, gray="coffee")
remaps("remap of color", 0, color="coffee")


@row("undistort, its map made anew", 2, within(6, 0.99), gray="coffee")
def _(p):
    to, (k, bends) = np.empty_like(p.gray), lens(p)
    return lambda: cv2.undistort(p.gray, k, bends, to, k)


# --- files ---

@row("BMP24 decode in memory", 2.3, exact, color="coffee")
def _(p):
    data = cv2.imencode(".bmp", p.color)[1]
    return lambda: cv2.imdecode(data, cv2.IMREAD_COLOR)


@row("BMP24 encode in memory", 3, file_of, color="coffee")
def _(p):
    return lambda: cv2.imencode(".bmp", p.color)[1]


@row("PGM decode in memory", 0, exact, gray="coffee")
def _(p):
    data = cv2.imencode(".pgm", p.gray)[1]
    return lambda: cv2.imdecode(data, cv2.IMREAD_GRAYSCALE)


@row("PGM encode in memory", 0, file_of, gray="coffee")
def _(p):
    return lambda: cv2.imencode(".pgm", p.gray)[1]
