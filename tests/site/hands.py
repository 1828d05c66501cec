"""What a reader's hand does: it drags with a mouse, or swipes with its fingers."""


def spot(locator, right=0.5, down=0.5):
    """The point of a box at these shares of its width and its height: its middle."""
    box = locator.bounding_box()
    return box["x"] + right * box["width"], box["y"] + down * box["height"]


def drag(page, handle, right, down, beside=0, button="left"):
    """A handle is pressed, so far beside its middle, and moved by so many pixels."""
    x, y = spot(handle)
    page.mouse.move(x + beside, y)
    page.mouse.down(button=button)
    page.mouse.move(x + beside + right, y + down, steps=4)
    page.mouse.up(button=button)


def swipe(page, *fingers):
    """Each finger goes from a point to a point, through all that Chromium does to touches."""
    client = page.context.new_cdp_session(page)
    for step in range(7):
        points = [{"x": a + step / 6 * (c - a), "y": b + step / 6 * (d - b), "id": number}
                  for number, ((a, b), (c, d)) in enumerate(fingers)]
        client.send("Input.dispatchTouchEvent",
                    {"type": "touchMove" if step else "touchStart", "touchPoints": points})
    client.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
