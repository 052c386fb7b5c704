// Runs before the rest of the page is read, which says so itself by `isWhole` (loader.js): its script is the end of the
// file. A file that was cut short would be an empty page.
document.addEventListener("DOMContentLoaded", () => {
    if (document.documentElement.dataset.isWhole) return;
    const notice = document.createElement("p");
    notice.className = "notice";
    notice.setAttribute("role", "alert");
    notice.textContent = "This page is incomplete: the end of the file is missing. Download or copy it again.";
    document.body.replaceChildren(notice);
});
