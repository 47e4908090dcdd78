// A page from file:// may not start a Worker: what would run in one runs in a hidden frame, which talks alike.
if (location.protocol === "file:") {
  window.Worker = class {
    constructor(url) {
      this.frame = document.createElement("iframe");
      this.frame.hidden = true;
      document.body.appendChild(this.frame);
      this.inner = this.frame.contentWindow;
      this.inner.postMessage = (data) => setTimeout(() => this.onmessage?.({ data }));
      this.ready = new Promise((done, failed) => {
        const script = this.inner.document.createElement("script");
        Object.assign(script, { src: url, onload: done, onerror: failed });
        this.inner.document.body.appendChild(script);
      });
      this.ready.catch((event) => this.onerror?.(event));
    }
    postMessage(data) {
      this.ready.then(() => setTimeout(() => this.inner.onmessage?.({ data })));
    }
    terminate() {
      this.frame.remove();
    }
  };
}
